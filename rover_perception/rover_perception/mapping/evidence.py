"""Evidence per cell: how often, how surely and from how near it was observed free or blocked.

Each frame adds to sums, so the order of frames does not matter, and better observations outvote
wrong ones. The certainty of one observation depends on pixels: a cell many rows below the row where
the ground ends is certainly free at any range, a cell at that row is not. Its weight depends on
range: errors from afar repeat in every frame, so no number of distant observations may outvote a
near one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from rover_common.cell_region import CellRegion
from rover_common.geometry import Pose
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import GroundColumns
from rover_perception.mapping.field_of_view import NEAREST, FieldOfView

EDGE_ERROR = 0.5  # [px] of the row where the ground ends: half a row
FLOOR_ERROR = 0.03  # [m] height of ground that is still bright: the first 0.2 m of a wall's base
BASE_DEPTH = 0.5  # [m] behind an obstacle's base that counts as observed
# An obstacle continues to an unknown depth behind its base. This guess has a low weight, but more
# than ground observed from afar: sand that rises towards a wall looks like ground beyond it.
BODY_DEPTH = (
    6.0  # [m] of an obstacle that is guessed; the weight falls with the square of the depth
)
# A pixel's length on the ground grows with the square of the range; weight is its inverse square.
FULL_WEIGHT_RANGE = 2.0  # [m] up to here, every observation has the weight 1
NEAREST_DEPTH = 0.1  # [m] in front of the camera; nearer cells are skipped


class EvidenceGrid:
    """Sums of evidence over the world, each (rows, cols) float32."""

    def __init__(self, field_of_view: FieldOfView) -> None:
        """`field_of_view`: of the cells of this grid; ground beyond its range is not mapped."""
        self.geometry = geometry = field_of_view.geometry
        shape = geometry.rows, geometry.cols
        self.free = np.zeros(shape, np.float32)  # weighted observations
        self.blocked = np.zeros(shape, np.float32)  # weighted observations
        # certain observations from any range: of free ground, and of the base of an obstacle
        self.free_observations = np.zeros(shape, np.float32)
        self.base_observations = np.zeros(shape, np.float32)
        # the same, of bases too coarse in the image to tell on which side of the edge a cell lies
        self.edge_observations = np.zeros(shape, np.float32)
        self._field_of_view = field_of_view
        self._changed: CellRegion | None = None

    def add(
        self, projection: GroundProjection, columns: GroundColumns, pose: Pose
    ) -> tuple[NDArray, NDArray]:
        """Add one frame; returns the level-frame points (x, y) [m] of the cells observed free."""
        self._mark_changed(pose)
        cell, x, y = self._field_of_view.cells_at(pose)
        u, v, depth = projection.pixels(x, y)
        in_image = (u >= 0) & (u < len(columns.reach)) & (v < projection.camera.height)
        visible = np.flatnonzero(in_image & (depth > NEAREST_DEPTH) & (x > NEAREST))
        cell, x, y = cell[visible], x[visible], y[visible]
        column, v = u[visible].astype(np.intp), v[visible]
        below = v - columns.horizon.astype(np.float32)[column]  # [px] below the horizon
        margin = v - columns.reach.astype(np.float32)[column]  # [px] below the end of the ground
        spread = np.float32(projection.height_error + FLOOR_ERROR / projection.height)
        error = np.sqrt(EDGE_ERROR**2 + np.square(below * spread))  # [px]
        is_free = margin > 0
        free = np.flatnonzero(is_free)
        x, y = x[free], y[free]
        self._add_free(cell[free], margin[free] / error[free], x * x + y * y)
        beyond = np.flatnonzero(~is_free & columns.blocked[column])
        self._add_blocked(projection, cell[beyond], margin[beyond], below[beyond], error[beyond])
        return x, y

    def memory(self) -> Callable[[], dict[str, NDArray]]:
        """A copy of all evidence; the call makes arrays of it, of the observed cells alone."""
        sums = [plane.copy() for plane in self._planes]

        def arrays() -> dict[str, NDArray]:
            flat = np.stack(sums).reshape(len(sums), -1)
            cells = np.flatnonzero(flat.any(axis=0))
            return {"cells": cells.astype(np.int32), "evidence": flat[:, cells]}

        return arrays

    def restore(self, arrays: Mapping[str, NDArray]) -> None:
        """Take what `memory` made; raises ValueError or KeyError for arrays of another grid."""
        cells, evidence = arrays["cells"], arrays["evidence"]
        size = self.free.size
        if evidence.shape != (len(self._planes), len(cells)) or (len(cells) and cells[-1] >= size):
            raise ValueError(f"evidence of another grid than {self.free.shape}")
        for plane, values in zip(self._planes, evidence, strict=True):
            plane.reshape(-1)[cells] = values
        self._changed = CellRegion.of_grid(self.geometry)

    @property
    def _planes(self) -> tuple[NDArray[np.float32], ...]:
        return (
            self.free,
            self.blocked,
            self.free_observations,
            self.base_observations,
            self.edge_observations,
        )

    def take_changed(self) -> CellRegion | None:
        """The cells that may have changed since the call before; None if there are none."""
        changed, self._changed = self._changed, None
        return changed

    def _mark_changed(self, pose: Pose) -> None:
        row, col = map(int, self.geometry.cell_of(pose.x, pose.y))
        region = CellRegion.around(row, col, self._field_of_view.reach, self.geometry)
        self._changed = region if self._changed is None else self._changed.union(region)

    def _add_free(self, cell: NDArray, margin: NDArray, squared_distance: NDArray) -> None:
        """`margin` in standard deviations, `squared_distance` [m^2] of each cell."""
        certainty = 1.0 - np.exp(-0.5 * np.square(margin))
        _add_at(self.free, cell, certainty * _weight(squared_distance))
        _add_at(self.free_observations, cell, certainty)

    def _add_blocked(
        self,
        projection: GroundProjection,
        cell: NDArray,
        margin: NDArray,
        below: NDArray,
        error: NDArray,
    ) -> None:
        """Cells behind the base of an obstacle.

        `margin` [px]: rows below the base, negative; `below` [px]: rows below the horizon; `error`
        [px]: standard deviation of the first.
        """
        base = below - margin
        scale = np.float32(projection.height * projection.camera.focal)  # [m px] range times rows
        distance = scale / np.maximum(base, np.float32(0.5))
        behind = scale / np.maximum(below, np.float32(0.1)) - distance
        body = np.flatnonzero(behind < BODY_DEPTH)
        cell, behind = cell[body], np.maximum(behind[body], np.float32(0.01))
        squared_distance = np.square(distance[body])
        base_rows = scale * BASE_DEPTH / squared_distance
        certainty = 1.0 - np.exp(-0.5 * np.square(base_rows / error[body]))
        guess = np.minimum(1.0, np.square(BASE_DEPTH / behind))
        _add_at(self.blocked, cell, certainty * guess * _weight(squared_distance))
        near = np.flatnonzero(behind < BASE_DEPTH)
        # Just behind the base, a cell is no more certainly blocked than one just before it is free.
        # Otherwise many distant observations of an edge would mark it as explored.
        at_base = body[near]
        separated = 1.0 - np.exp(-0.5 * np.square(margin[at_base] / error[at_base]))
        _add_at(self.base_observations, cell[near], certainty[near] * separated)
        _add_at(self.edge_observations, cell[near], certainty[near] * (1.0 - separated))


def _add_at(sums: NDArray, cell: NDArray, amount: NDArray) -> None:
    """Add to the cells of a grid, by their flat indices; faster than `sums[cell] += amount`."""
    np.add.at(sums.reshape(-1), cell, amount)


def _weight(squared_distance: NDArray) -> NDArray:
    """The weight of an observation from a distance, by its square [m^2]."""
    return np.minimum(1.0, np.square(FULL_WEIGHT_RANGE**2 / squared_distance))
