"""Distances on grids, which worlds are made of: exact, on any machine."""

import cv2
import numpy as np
import pytest
from scipy import ndimage

from rover_simulator.world.distances import depth_of


@pytest.fixture(params=[1, 2])
def threads(request):
    """OpenCV takes other ways with one thread and with more."""
    before = cv2.getNumThreads()
    cv2.setNumThreads(request.param)
    yield
    cv2.setNumThreads(before)


@pytest.mark.usefixtures("threads")
def test_distances_are_those_of_scipy_to_the_bit():
    random = np.random.default_rng(0)
    for share in (0.0001, 0.001, 0.1, 0.9):
        cells = random.random((400, 300)) > share
        exact = ndimage.distance_transform_edt(cells).astype(np.float32)
        assert np.array_equal(depth_of(cells), exact)
