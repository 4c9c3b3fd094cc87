"""Distances on grids, which worlds are made of."""

from itertools import product

import numpy as np

from rover_simulator.world.distances import depth_of


def test_distances_are_exact():
    random = np.random.default_rng(0)
    cells = random.random((20, 30)) > 0.1
    unset = np.argwhere(~cells)
    depth = depth_of(cells)
    assert depth.dtype == np.float32
    for row, col in product(range(20), range(30)):
        nearest = np.hypot(*(unset - (row, col)).T).min()
        assert depth[row, col] == np.float32(nearest)
