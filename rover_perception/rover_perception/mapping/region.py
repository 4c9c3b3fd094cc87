"""A rectangle of a grid's cells."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.grid import GridGeometry


@dataclass(frozen=True)
class Region:
    """Half-open ranges of rows and columns: the start is inside, the stop is not."""

    row_start: int
    row_stop: int
    col_start: int
    col_stop: int

    @classmethod
    def of_grid(cls, geometry: GridGeometry) -> Region:
        """All cells."""
        return cls(0, geometry.rows, 0, geometry.cols)

    @classmethod
    def around(cls, row: int, col: int, reach: int, geometry: GridGeometry) -> Region:
        """The cells of the grid that are at most `reach` rows and columns away from a cell."""
        return cls(
            max(row - reach, 0),
            min(row + reach + 1, geometry.rows),
            max(col - reach, 0),
            min(col + reach + 1, geometry.cols),
        )

    def union(self, other: Region) -> Region:
        """The smallest region that contains both."""
        return Region(
            min(self.row_start, other.row_start),
            max(self.row_stop, other.row_stop),
            min(self.col_start, other.col_start),
            max(self.col_stop, other.col_stop),
        )

    def in_blocks(self, count: int) -> Region:
        """The blocks of `count` x `count` cells that this region touches, counted in blocks."""
        return Region(
            self.row_start // count,
            -(-self.row_stop // count),
            self.col_start // count,
            -(-self.col_stop // count),
        )

    def in_cells(self, count: int) -> Region:
        """A region of blocks of `count` x `count` cells, counted in cells."""
        return Region(
            self.row_start * count,
            self.row_stop * count,
            self.col_start * count,
            self.col_stop * count,
        )

    @property
    def slices(self) -> tuple[slice, slice]:
        """To index an array (rows, cols)."""
        return slice(self.row_start, self.row_stop), slice(self.col_start, self.col_stop)
