"""Shared by the rover's packages: types, camera, grids, scoring, and what the nodes have in common."""
