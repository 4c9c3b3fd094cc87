"""Regions by runs are those that labelling finds cell by cell."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from rover_navigation.run_length import RunLengthRegions, labels_of_cells

MASKS = arrays(
    np.uint8, st.tuples(st.integers(1, 12), st.integers(1, 12)), elements=st.integers(0, 1)
)


@settings(max_examples=300, deadline=None)
@given(MASKS)
def test_sizes_are_those_of_labelled_regions(mask):
    labels, count = ndimage.label(mask)
    sizes = np.bincount(labels.ravel(), minlength=count + 1).astype(float)
    for side in (labels[0], labels[-1], labels[:, 0], labels[:, -1]):
        sizes[side] = np.inf
    sizes[0] = 0.0
    rows, cols = np.indices(mask.shape).reshape(2, -1)
    found = RunLengthRegions(mask).sizes_at(rows, cols)
    assert found.tolist() == sizes[labels[rows, cols]].tolist()


@settings(max_examples=50, deadline=None)
@given(MASKS)
def test_beside_the_mask_there_is_nothing(mask):
    rows, cols = mask.shape
    regions = RunLengthRegions(mask)
    for row in (-1, rows):
        columns = np.arange(-1, cols + 1)
        assert not regions.sizes_at(np.full(len(columns), row), columns).any()
    for col in (-1, cols):
        assert not regions.sizes_at(np.arange(rows), np.full(rows, col)).any()


@settings(max_examples=300, deadline=None)
@given(MASKS)
def test_labels_of_cells_are_those_of_their_picture(mask):
    rows, cols = np.nonzero(mask)
    labels, _ = ndimage.label(mask, structure=np.ones((3, 3)))
    assert labels_of_cells(rows, cols).tolist() == (labels[rows, cols] - 1).tolist()
