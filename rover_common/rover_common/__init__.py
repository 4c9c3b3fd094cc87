"""Shared by the rover's packages: types, camera, grids, scoring, parts of nodes."""
