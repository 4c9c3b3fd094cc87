"""A rectangle of a grid's cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.grid import GridGeometry


@dataclass(frozen=True)
class CellRegion:
    """Half-open ranges of rows and columns: the start is inside, the stop is not."""

    row_start: int
    row_stop: int
    col_start: int
    col_stop: int

    @classmethod
    def of_grid(cls, geometry: GridGeometry) -> CellRegion:
        """All cells."""
        return cls(0, geometry.rows, 0, geometry.cols)

    @classmethod
    def around(cls, row: int, col: int, reach: int, geometry: GridGeometry) -> CellRegion:
        """The cells of the grid that are at most `reach` rows and columns away from a cell."""
        return cls(
            max(row - reach, 0),
            min(row + reach + 1, geometry.rows),
            max(col - reach, 0),
            min(col + reach + 1, geometry.cols),
        )

    @classmethod
    def of_true(cls, mask: NDArray[np.bool_]) -> CellRegion | None:
        """The smallest region with all true cells (rows, cols); None where there are none."""
        rows, cols = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
        return cls.of_cells(rows, cols) if len(rows) else None

    @classmethod
    def of_cells(cls, rows: NDArray[np.intp], cols: NDArray[np.intp]) -> CellRegion:
        """The smallest region with all of these rows and columns, at least one of each."""
        return cls(int(rows.min()), int(rows.max()) + 1, int(cols.min()), int(cols.max()) + 1)

    def grown(self, count: int, shape: tuple[int, ...]) -> CellRegion:
        """With `count` cells more on every side, within a grid of this shape (rows, cols)."""
        rows, cols = shape
        return CellRegion(
            min(max(self.row_start - count, 0), rows),
            max(min(self.row_stop + count, rows), 0),
            min(max(self.col_start - count, 0), cols),
            max(min(self.col_stop + count, cols), 0),
        )

    def union(self, other: CellRegion) -> CellRegion:
        """The smallest region that contains both."""
        return CellRegion(
            min(self.row_start, other.row_start),
            max(self.row_stop, other.row_stop),
            min(self.col_start, other.col_start),
            max(self.col_stop, other.col_stop),
        )

    def in_blocks(self, count: int) -> CellRegion:
        """The blocks of `count` x `count` cells that this region touches, counted in blocks."""
        return CellRegion(
            self.row_start // count,
            -(-self.row_stop // count),
            self.col_start // count,
            -(-self.col_stop // count),
        )

    def in_cells(self, count: int) -> CellRegion:
        """A region of blocks of `count` x `count` cells, counted in cells."""
        return CellRegion(
            self.row_start * count,
            self.row_stop * count,
            self.col_start * count,
            self.col_stop * count,
        )

    @property
    def slices(self) -> tuple[slice, slice]:
        """To index an array (rows, cols)."""
        return slice(self.row_start, self.row_stop), slice(self.col_start, self.col_stop)

    def slices_in(self, outer: CellRegion) -> tuple[slice, slice]:
        """To index an array of the cells of another region, which contains this one."""
        return (
            slice(self.row_start - outer.row_start, self.row_stop - outer.row_start),
            slice(self.col_start - outer.col_start, self.col_stop - outer.col_start),
        )
