"""Connected regions of a mask by its runs, and of single cells.

What labelling costs depends on the length of the borders, and not on the number of cells.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


class RunLengthRegions:
    """Regions of true cells (rows, cols) that share an edge: sizes, and which has no known end."""

    def __init__(self, mask: NDArray[np.uint8]) -> None:
        """mask (rows, cols): 0 or 1."""
        rows, cols = mask.shape
        self._stride = cols + 1
        padded = np.zeros((rows + 1, self._stride), np.uint8)  # no run leaves its row
        padded[1:, 1:] = mask
        flat = padded.ravel()
        ends = np.flatnonzero(flat[1:] != flat[:-1]) + 1
        if len(ends) % 2:
            ends = np.append(ends, len(flat))
        self._starts, self._ends = ends[::2], ends[1::2]  # the runs, in order
        self._sizes = self._sizes_of_runs(rows, cols)

    def sizes_at(self, rows: NDArray[np.intp], cols: NDArray[np.intp]) -> NDArray[np.float32]:
        """(n,) [cells] of the regions of these cells, inf at the mask's border, 0 for false ones.

        The cells may lie beside the mask by one.
        """
        if len(self._starts) == 0:
            return np.zeros(len(rows), np.float32)
        flat = (rows + 1) * self._stride + cols + 1
        run = np.searchsorted(self._starts, flat, "right") - 1
        inside = (run >= 0) & (flat < self._ends[run])
        return np.where(inside, self._sizes[run], np.float32(0.0))

    def _sizes_of_runs(self, rows: int, cols: int) -> NDArray[np.float32]:
        starts, ends, stride = self._starts, self._ends, self._stride
        # In the next row each run touches those that end after its start and start before its end.
        first = np.searchsorted(ends, starts + stride, "right")
        touched = np.maximum(np.searchsorted(starts, ends + stride, "left") - first, 0)
        above = np.arange(len(starts)).repeat(touched)
        skipped = np.cumsum(touched) - touched
        below = np.arange(len(above)) + (first - skipped).repeat(touched)
        label = _labels(above, below, len(starts))
        sizes = np.bincount(label, weights=ends - starts).astype(np.float32)
        row = starts // stride
        at_border = (row == 1) | (row == rows) | (starts % stride == 1) | (ends % stride == 0)
        sizes[label[at_border]] = np.inf
        return sizes[label]


def labels_of_cells(rows: NDArray[np.intp], cols: NDArray[np.intp]) -> NDArray[np.int32]:
    """Which of these cells (n,), given row by row, are connected: labels from 0 in their order.

    Corners connect, too.
    """
    stride = int(cols.max(initial=0)) + 2
    flat = rows * stride + cols
    pairs = []
    for step in (1, stride - 1, stride, stride + 1):  # half of the neighbours
        at = np.minimum(np.searchsorted(flat, flat + step), len(flat) - 1)
        here = np.flatnonzero(flat[at] == flat + step)
        pairs.append((here, at[here]))
    first, second = (np.concatenate(ends) for ends in zip(*pairs, strict=True))
    return _labels(first, second, len(flat))


def _labels(first: NDArray[np.intp], second: NDArray[np.intp], count: int) -> NDArray[np.int32]:
    """Which of `count` things are connected, by pairs of them."""
    ends = (first.astype(np.int32), second.astype(np.int32))
    graph = coo_array((np.ones(len(first), np.int8), ends), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1])
