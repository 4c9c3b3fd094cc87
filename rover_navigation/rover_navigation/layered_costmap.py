"""The costmap of a robot that maps while it drives: computed anew only where the map has changed.

What one more view costs then depends on the view, and not on all that is known.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rover_common.cell_region import CellRegion
from rover_common.grid import GridGeometry
from rover_common.types import GridMap
from rover_navigation.costmap import (
    Costmap,
    GroundLayers,
    distance_to,
    draw_discs,
    even_cells,
    ground_layers,
    hidden_reach,
    known_region,
    part_of,
    walls_of,
)
from rover_navigation.scale import Scale
from rover_navigation.types import NO_POINTS, BlockedPlace


class Changed(NamedTuple):
    """What was computed anew."""

    ground: CellRegion  # what is free, and what is unknown
    clearance: CellRegion  # holds that region


class LayeredCostmap:
    """All layers of one map in its whole size; `update` brings them up to date.

    They are those of `Costmap.of`, with every clearance cut off at the scale's limit, so that what
    an obstacle changes has an end. `known` is the region that `Costmap.of` has.
    """

    def __init__(self, scale: Scale, whole: GridGeometry) -> None:
        """whole: of the map, with an even number of rows and columns. Nothing is known on it."""
        self._scale = scale
        shape = (whole.rows, whole.cols)
        self._cells: NDArray[np.int8] = np.full(shape, -1, np.int8)
        self._trail, self._blocked = NO_POINTS, frozenset[BlockedPlace]()
        self._body: tuple[float, float] | None = None
        self._been, self._under_body = np.zeros(shape, bool), np.zeros(shape, bool)
        self._obstacle = np.zeros(shape, bool)
        self._certain_walls, self._all_walls = np.zeros(shape, bool), np.zeros(shape, bool)
        far = [np.full(shape, scale.clearance_limit, np.float32) for _ in range(2)]
        self.costmap = Costmap(
            whole, np.zeros(shape, bool), np.ones(shape, bool), np.zeros(shape, bool), *far
        )
        self.known = CellRegion.of_grid(whole)

    def goes_on_with(self, grid: GridMap, trail: NDArray[np.float64]) -> bool:
        """Whether these can be the next ones: a map as large, and a trail that has grown."""
        count = len(self._trail)
        same = even_cells(grid)[0] == self.costmap.geometry
        return same and len(trail) >= count and np.array_equal(trail[:count], self._trail)

    def update(
        self,
        grid: GridMap,
        trail: NDArray[np.float64],
        body: tuple[float, float],
        blocked: tuple[BlockedPlace, ...] = (),
    ) -> Changed | None:
        """Take what `Costmap.of` takes; which cells were computed anew, if any."""
        whole, cells = even_cells(grid)
        regions = [CellRegion.of_true(cells != self._cells)]
        regions += self._extend_trail(trail)
        if body != self._body:
            radius = self._scale.blind_radius
            regions += [self._around(at, radius) for at in (self._body, body) if at is not None]
        places = frozenset(blocked)
        regions += [self._around((it.x, it.y), it.radius) for it in places ^ self._blocked]
        self._cells, self._body, self._blocked = cells, body, places
        self.known = known_region(whole, cells, body)
        changed = _union(regions)
        return None if changed is None else self._compute(changed)

    def _extend_trail(self, trail: NDArray[np.float64]) -> list[CellRegion]:
        """The regions that its new points change."""
        new, self._trail = trail[len(self._trail) :], trail
        if len(new) == 0:
            return []
        scale, whole = self._scale, self.costmap.geometry
        draw_discs(self._been, whole, new, scale.trail_radius)
        draw_discs(self._under_body, whole, new, scale.under_body_radius)
        radius = max(scale.trail_radius, scale.under_body_radius)
        reach = math.ceil(radius / whole.resolution) + 1
        points = CellRegion.of_cells(*whole.nearest_cell_to(new[:, 0], new[:, 1]))
        return [points.grown(reach, self._cells.shape)]

    def _around(self, point: tuple[float, float], radius: float) -> CellRegion:
        whole = self.costmap.geometry
        row, col = (int(i) for i in whole.nearest_cell_to(*point))
        reach = math.ceil(radius / whole.resolution) + 1
        return CellRegion.around(row, col, reach, whole)

    def _compute(self, changed: CellRegion) -> Changed:
        """All layers, from the lowest on: each reaches as far around as it depends on the last."""
        costmap, scale, shape = self.costmap, self._scale, self._cells.shape
        resolution = costmap.geometry.resolution
        hidden = hidden_reach(scale, resolution)
        clear = math.ceil(scale.clearance_limit / resolution + 0.5)
        self._compute_ground(changed)
        walled = changed.grown(hidden, shape)
        self._compute_walls(walled, walled.grown(hidden, shape))
        cleared = walled.grown(clear, shape)
        around = cleared.grown(clear, shape)
        inner = cleared.slices_in(around)
        for walls, clearance in (
            (self._certain_walls, costmap.clearance),
            (self._all_walls, costmap.edge_clearance),
        ):
            distance = distance_to(walls[around.slices], resolution)[inner]
            np.minimum(distance, scale.clearance_limit, out=clearance[cleared.slices])
        return Changed(changed, cleared)

    def _compute_ground(self, region: CellRegion) -> None:
        costmap, cells = self.costmap, region.slices
        geometry = part_of(costmap.geometry, region)
        been = self._been[cells].copy()
        draw_discs(been, geometry, np.array([self._body]), self._scale.blind_radius)
        under_body, places = self._under_body[cells], tuple(self._blocked)
        layers = ground_layers(self._cells[cells], been, under_body, geometry, places)
        self._obstacle[cells] = layers.obstacle
        costmap.unknown[cells], costmap.edge[cells] = layers.unknown, layers.edge
        costmap.free[cells] = ~layers.obstacle & ~layers.unknown

    def _compute_walls(self, region: CellRegion, around: CellRegion) -> None:
        """around: all that the walls of the region depend on."""
        costmap, cells = self.costmap, around.slices
        layers = GroundLayers(self._obstacle[cells], costmap.unknown[cells], costmap.edge[cells])
        walls = walls_of(layers, self._scale, costmap.geometry.resolution)
        inner = region.slices_in(around)
        self._certain_walls[region.slices] = walls.certain[inner]
        self._all_walls[region.slices] = walls.all[inner]


def _union(regions: list[CellRegion | None]) -> CellRegion | None:
    """Of those that there are."""
    whole = None
    for region in regions:
        if region is not None:
            whole = region if whole is None else whole.union(region)
    return whole
