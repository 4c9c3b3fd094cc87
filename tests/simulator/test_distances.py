"""Distances on grids are those of scipy, to the bit."""

import numpy as np
from scipy import ndimage

from rover_simulator.world.distances import depth_of


def test_distances_are_those_of_scipy_to_the_bit():
    random = np.random.default_rng(0)
    for share in (0.001, 0.1, 0.9):
        cells = random.random((400, 300)) > share
        exact = ndimage.distance_transform_edt(cells).astype(np.float32)
        assert np.array_equal(depth_of(cells), exact)
