"""The navigation map as the planner needs it: what is free, what is unknown, the clearance."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.cell_region import CellRegion
from rover_common.grid import GridGeometry
from rover_common.map_encoding import EDGE, FREE_BELOW
from rover_common.types import GridMap
from rover_navigation.scale import Scale
from rover_navigation.types import BlockedPlace

MARGIN = 12  # [cells] kept around what is known
NOWHERE = np.float32(1e9)  # [cells] to a cell that there is none of


@dataclass(frozen=True)
class Costmap:
    """A part of the navigation map; all arrays (rows, cols), an even number of each."""

    geometry: GridGeometry
    free: NDArray[np.bool_]
    unknown: NDArray[np.bool_]  # edges seen from afar as well
    edge: NDArray[np.bool_]
    # [m] from a cell's centre to the border of the nearest obstacle, or of what it may hide
    clearance: NDArray[np.float32]
    # [m] the same, to edges beside obstacles as well. Those are only driven by with care: where a
    # passage is narrow, edges seen from afar would close it.
    edge_clearance: NDArray[np.float32]

    @classmethod
    def of(
        cls,
        grid: GridMap,
        trail: NDArray[np.float64],
        body: tuple[float, float],
        scale: Scale,
        blocked: tuple[BlockedPlace, ...] = (),
    ) -> Costmap:
        """`trail` (n, 2) [m]: where the robot has been; `body` [m]: where it stands."""
        whole, cells = even_cells(grid)
        part = known_region(whole, cells, body)
        geometry = part_of(whole, part)
        been = np.zeros((geometry.rows, geometry.cols), bool)
        under_body = been.copy()
        draw_discs(been, geometry, trail, scale.trail_radius)
        draw_discs(under_body, geometry, trail, scale.under_body_radius)
        draw_discs(been, geometry, np.array([body]), scale.blind_radius)
        layers = ground_layers(cells[part.slices], been, under_body, geometry, blocked)
        walls = walls_of(layers, scale, geometry.resolution)
        return cls(
            geometry,
            ~layers.obstacle & ~layers.unknown,
            layers.unknown,
            layers.edge,
            clearance=distance_to(walls.certain, geometry.resolution),
            edge_clearance=distance_to(walls.all, geometry.resolution),
        )

    def part(self, region: CellRegion) -> Costmap:
        """Some of its cells; its arrays are views of these."""
        cells = region.slices
        return Costmap(
            part_of(self.geometry, region),
            self.free[cells],
            self.unknown[cells],
            self.edge[cells],
            self.clearance[cells],
            self.edge_clearance[cells],
        )


class GroundLayers(NamedTuple):
    """What is where, (rows, cols) each."""

    obstacle: NDArray[np.bool_]
    unknown: NDArray[np.bool_]  # edges seen from afar as well
    edge: NDArray[np.bool_]


class Walls(NamedTuple):
    """What clearance is kept from, (rows, cols) each."""

    certain: NDArray[np.bool_]  # obstacles, and what they may hide
    all: NDArray[np.bool_]  # edges beside obstacles as well


def ground_layers(
    cells: NDArray[np.int8],
    been: NDArray[np.bool_],
    under_body: NDArray[np.bool_],
    geometry: GridGeometry,
    blocked: tuple[BlockedPlace, ...],
) -> GroundLayers:
    """Of the cells of a map, or of a part of it, whose geometry it is.

    `been`: free when unknown, because the robot is or was there; `under_body`: free in any case.
    """
    edge = cells == EDGE
    obstacle = (cells >= FREE_BELOW) & ~edge & ~under_body
    unknown = ((cells < 0) | edge) & ~been
    for place in blocked:
        disc = np.zeros(cells.shape, bool)
        draw_discs(disc, geometry, np.array([[place.x, place.y]]), place.radius)
        obstacle |= disc
        unknown &= ~disc
    return GroundLayers(obstacle, unknown, edge & unknown)


def walls_of(layers: GroundLayers, scale: Scale, resolution: float) -> Walls:
    """Of the ground with its obstacles; a cell depends on those `hidden_reach` around it."""
    reach = hidden_reach(scale, resolution)
    beside = _grown(layers.obstacle, reach) & layers.unknown
    return Walls(layers.obstacle | (beside & ~layers.edge), layers.obstacle | beside)


def hidden_reach(scale: Scale, resolution: float) -> int:
    """[cells] within which an obstacle hides ground."""
    return round(scale.hidden_side / resolution)


def even_cells(grid: GridMap) -> tuple[GridGeometry, NDArray[np.int8]]:
    """The map's cells, with an unknown row or column more where their number is odd."""
    odd = [(0, count % 2) for count in grid.cells.shape]
    cells = np.pad(grid.cells, odd, constant_values=-1) if np.any(odd) else grid.cells
    rows, cols = cells.shape
    return GridGeometry(grid.resolution, rows, cols, grid.origin_x, grid.origin_y), cells


def known_region(
    whole: GridGeometry, cells: NDArray[np.int8], body: tuple[float, float]
) -> CellRegion:
    """The known part of the map and the body, with a margin; never empty."""
    row, col = (int(i) for i in whole.nearest_cell_to(*body))
    here = CellRegion(row, row + 1, col, col + 1)
    known = CellRegion.of_true(cells >= 0)
    part = here if known is None else known.union(here)
    part = part.grown(MARGIN, cells.shape)
    return CellRegion(*(side // 2 * 2 for side in dataclasses.astuple(part)))


def part_of(whole: GridGeometry, part: CellRegion) -> GridGeometry:
    """Of some of its cells."""
    resolution = whole.resolution
    return GridGeometry(
        resolution,
        part.row_stop - part.row_start,
        part.col_stop - part.col_start,
        whole.origin_x + part.col_start * resolution,
        whole.origin_y + part.row_start * resolution,
    )


def distance_to(mask: NDArray[np.bool_], resolution: float) -> NDArray[np.float32]:
    """[m] from each cell's centre to the border of the nearest true cell, or very many."""
    cells = cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 5)
    cells = np.minimum(np.asarray(cells, np.float32), NOWHERE)
    return np.maximum(0.0, cells * resolution - resolution / 2)


def _grown(mask: NDArray[np.bool_], cells: int) -> NDArray[np.bool_]:
    """The mask with all that lies within so many cells of it."""
    size = 2 * cells + 1
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    return np.asarray(cv2.dilate(mask.astype(np.uint8), disc) > 0)


def draw_discs(
    mask: NDArray[np.bool_], geometry: GridGeometry, points: NDArray[np.float64], radius: float
) -> None:
    """Set the cells within a radius [m] of any of the points (n, 2) [m], which may lie outside."""
    cells = np.stack(geometry.cell_of(points[:, 0], points[:, 1]))
    disc = _disc_cells(round(radius / geometry.resolution))
    # Of a trail, each cell once: a robot that comes back costs nothing more.
    rows, cols = (np.unique(cells, axis=1)[:, :, None] + disc[:, None]).reshape(2, -1)
    inside = geometry.contains(rows, cols)
    mask[rows[inside], cols[inside]] = True


@cache
def _disc_cells(radius: int) -> NDArray[np.intp]:
    """Rows and columns (2, n) of a disc of so many cells, from its middle."""
    picture = np.zeros((2 * radius + 1, 2 * radius + 1), np.uint8)
    cv2.circle(picture, (radius, radius), radius, 1, -1)
    return np.stack(np.nonzero(picture)) - radius
