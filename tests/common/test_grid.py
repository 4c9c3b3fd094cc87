"""Regular grids over the world."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rover_common.grid import GridGeometry


@given(st.integers(0, 399), st.integers(0, 399))
def test_a_cells_centre_lies_in_the_cell(row, col):
    grid = GridGeometry.of_world(0.5)
    x, y = grid.center_of(row, col)
    assert grid.cell_of(x, y) == (row, col)
    assert grid.contains(row, col)


def test_points_outside_are_outside():
    grid = GridGeometry.of_world(1.0)
    row, col = grid.cell_of([-0.1, 200.1, 5.0], [5.0, 5.0, -3.0])
    assert not grid.contains(row, col).any()


def test_row_follows_y_and_column_follows_x():
    row, col = GridGeometry.of_world(1.0).cell_of(3.5, 7.5)
    assert (int(row), int(col)) == (7, 3)


def test_grid_arrays_have_one_entry_per_point():
    row, col = GridGeometry.of_world(1.0).cell_of(np.zeros(4), np.zeros(4))
    assert row.shape == col.shape == (4,)
