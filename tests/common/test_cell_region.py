"""Regions of grids: in cells and in blocks of cells."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rover_common.cell_region import CellRegion
from rover_common.grid import GridGeometry

GEOMETRY = GridGeometry(1.0, rows=30, cols=40)


@given(st.integers(0, 29), st.integers(0, 39), st.integers(0, 12), st.integers(1, 7))
@settings(deadline=None)
def test_the_blocks_of_a_region_are_those_that_it_touches(row, col, reach, count):
    region = CellRegion.around(row, col, reach, GEOMETRY)
    cells = np.zeros((42, 42), bool)  # whole blocks
    cells[region.slices] = True
    rows, cols = np.nonzero(cells)
    blocks = region.in_blocks(count)
    touched = np.zeros((42, 42), bool)
    touched[rows // count, cols // count] = True
    inside = np.zeros((42, 42), bool)
    inside[blocks.slices] = True
    assert (inside == touched).all()
    inside = np.zeros((60, 60), bool)
    inside[blocks.in_cells(count).slices] = True
    assert inside[rows, cols].all()
    assert inside.sum() == touched.sum() * count**2


@pytest.mark.parametrize(("row", "col"), [(0, 0), (29, 39), (15, 20)])
def test_a_region_around_a_cell_stays_inside_the_grid(row, col):
    cells = np.zeros((30, 40), bool)
    cells[CellRegion.around(row, col, 3, GEOMETRY).slices] = True
    grid_row, grid_col = np.indices(cells.shape)
    near = (np.abs(grid_row - row) <= 3) & (np.abs(grid_col - col) <= 3)
    assert (cells == near).all()


def test_the_union_contains_both():
    union = CellRegion(2, 4, 10, 12).union(CellRegion(3, 8, 1, 5))
    assert union == CellRegion(2, 8, 1, 12)


@given(st.integers(0, 29), st.integers(0, 39), st.integers(0, 12), st.integers(0, 50))
@settings(deadline=None)
def test_a_region_grows_within_its_grid(row, col, reach, count):
    region = CellRegion.around(row, col, reach, GEOMETRY)
    cells = np.zeros((30, 40), bool)
    cells[region.slices] = True
    assert CellRegion.of_true(cells) == region
    grown = region.grown(count, cells.shape)
    rows, cols = np.indices(cells.shape)
    near_rows = (rows >= region.row_start - count) & (rows < region.row_stop + count)
    near_cols = (cols >= region.col_start - count) & (cols < region.col_stop + count)
    assert CellRegion.of_true(near_rows & near_cols) == grown
    assert cells[grown.slices][region.slices_in(grown)].all()
    assert cells[grown.slices][region.slices_in(grown)].size == cells.sum()


def test_a_region_without_cells_is_none():
    assert CellRegion.of_true(np.zeros((3, 4), bool)) is None
