"""Shared by the rover's packages: dataclasses, camera model, grids, scoring, and the nodes' common parts."""
