"""The explored share, against a true map."""

from __future__ import annotations

import numpy as np
import pytest

from rover_common.types import GridMap
from rover_navigation.mapped_share import mapped_share

TRUTH = np.zeros((4, 5), bool)
TRUTH[1:3, 1:5] = True  # 8 cells


def grid(cells: np.ndarray) -> GridMap:
    return GridMap(1.0, 0.0, 0.0, cells.astype(np.int8))


def test_only_navigable_cells_that_are_so_in_the_truth_count():
    cells = np.full(TRUTH.shape, -1)
    cells[0] = 0  # not in the truth
    cells[1, 1:3] = (0, 49)
    cells[2, 1:4] = (50, 100, -1)
    assert mapped_share(grid(cells), TRUTH) == 2 / 8


@pytest.mark.parametrize(("free", "share"), [(10, 0.0), (11, 1 / 8), (16, 1 / 8)])
def test_a_cell_of_the_truth_is_mapped_when_enough_of_it_is(free, share):
    cells = np.full((16, 20), -1)
    block = np.full(16, -1)
    block[:free] = 0
    cells[4:8, 4:8] = block.reshape(4, 4)
    assert mapped_share(grid(cells), TRUTH) == share
