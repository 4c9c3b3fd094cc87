"""Shared by the rover's packages: types, camera, grids, and what the nodes share."""
