"""All that a plan needs of the map and that depends on the surroundings of each cell alone."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.cell_region import CellRegion
from rover_common.types import GridMap
from rover_navigation import frontiers
from rover_navigation.costmap import Costmap, even_cells
from rover_navigation.frontiers import Borders
from rover_navigation.layered_costmap import LayeredCostmap
from rover_navigation.local_searches import LocalSearches
from rover_navigation.region import NearestCells
from rover_navigation.roadmap import Roadmap, TravelLayers
from rover_navigation.scale import Scale
from rover_navigation.types import PlanRequest


class PlanLayers:
    """Follows the map from request to request; all of it is computed anew only where it changed.

    `costmap` and `borders` show the known part, `roadmap` is that of the whole map. They hold until
    the next update.
    """

    costmap: Costmap
    borders: Borders
    roadmap: Roadmap
    nearest: tuple[NearestCells, NearestCells]  # drivable cells, and wide ones

    def __init__(self, scale: Scale) -> None:
        self._scale = scale
        self._layered: LayeredCostmap | None = None

    def update(self, request: PlanRequest) -> None:
        """Take the map of a request, with what the mission knows of the ground."""
        layered = self._layered
        if layered is None or not layered.goes_on_with(request.grid, request.trail):
            layered = self._begin(request.grid)
        body = (request.pose.x, request.pose.y)
        changed = layered.update(request.grid, request.trail, body, request.blocked)
        if changed is not None:
            self._find_borders(layered.costmap, changed.ground)
            self._find_travel(layered.costmap, changed.clearance)
        known = layered.known
        self.costmap = layered.costmap.part(known)
        self.borders = self._borders.part(known.slices)
        self.roadmap = Roadmap(layered.costmap, self._scale, self._travel, self._searches)

    def _begin(self, grid: GridMap) -> LayeredCostmap:
        layered = LayeredCostmap(self._scale, even_cells(grid)[0])
        self._layered = layered
        self._borders = Borders.of(layered.costmap)
        self._travel = TravelLayers.of(layered.costmap, self._scale)
        self._searches = LocalSearches()
        cell = grid.resolution * self._scale.roadmap_cells
        reach = math.ceil(max(self._scale.frontier_reach, self._scale.target_reach) / cell) + 1
        self.nearest = (NearestCells(reach), NearestCells(reach))
        return layered

    def _find_borders(self, costmap: Costmap, ground: CellRegion) -> None:
        shape = costmap.free.shape
        region = ground.grown(frontiers.REACH, shape)
        around = region.grown(frontiers.REACH, shape)
        _replace(self._borders, Borders.of(costmap.part(around)), region, around)

    def _find_travel(self, costmap: Costmap, clearance: CellRegion) -> None:
        cells, shape = self._scale.roadmap_cells, self._travel.drivable.shape
        region = clearance.in_blocks(cells).grown(1, shape)
        around = region.grown(1, shape)
        travel = TravelLayers.of(costmap.part(around.in_cells(cells)), self._scale)
        steps = travel.steps[region.slices_in(around)] != self._travel.steps[region.slices]
        rows, cols = np.nonzero(steps.any(axis=2))
        rows, cols = rows + region.row_start, cols + region.col_start
        self._searches.forget(rows * shape[1] + cols)
        _replace(self._travel, travel, region, around)


def _replace(
    layers: tuple[NDArray[np.generic], ...],
    new: tuple[NDArray[np.generic], ...],
    region: CellRegion,
    around: CellRegion,
) -> None:
    """Write a region of the new layers, which are those of the cells around it."""
    for layer, part in zip(layers, new, strict=True):
        layer[region.slices] = part[region.slices_in(around)]
