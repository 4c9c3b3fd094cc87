"""Perception's stages as panels."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from rover_common.map_encoding import navigable_cells
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.vision import vision_image
from rover_perception.mapping.evidence import EvidenceGrid
from rover_perception.mapping.field_of_view import FieldOfView
from rover_perception.mapping.occupancy import OccupancyMaps
from rover_tools.explain.axes import (
    AHEAD,
    ASIDE,
    FAINT,
    GROUND,
    LINE,
    OBSTACLE,
    ROCKS,
    SEEN,
    ground_axes,
    image_axes,
    map_axes,
    polar_axes,
    show_on_ground,
)  # fmt: skip
from rover_tools.explain.naming import name_of
from rover_tools.explain.our_stages import OurStages
from rover_tools.explain.panels import Panel

STEP = 0.025  # [m] between two points of the top view
EXTENT = (ASIDE, -ASIDE, 0.0, AHEAD)
GRID_AHEAD, GRID_ASIDE = (1.0, 12.0), 6.0  # [m] of the calibration grid
Draw = Callable[[Any, OurStages], None]
LABELLED = (1.0, 2.0, 4.0)  # [m] ahead
NEAREST_DEPTH = 0.1  # [m] points nearer to the camera have no pixel


def our_panels(stages: OurStages) -> tuple[Panel, ...]:
    """One for each stage, in their order."""
    names = stages.names
    degrees = math.degrees(stages.pose.pitch), math.degrees(stages.pose.roll)
    free = int(np.count_nonzero(navigable_cells(stages.grid.cells)))

    def panel(stage: str, draw: Draw, *of_code: str, note: str = "", polar: bool = False) -> Panel:
        return Panel(stage, of_code, lambda ax: draw(ax, stages), note, polar)

    return (
        panel("grid", _grid, names["projection"], name_of(GroundProjection.pixels),
              note=f"pitch {degrees[0]:.1f}°, roll {degrees[1]:.1f}°"),
        panel("top view", _top_view, name_of(GroundProjection.pixels),
              note="by the camera at this pitch and roll"),
        panel("field of view", _field_of_view, name_of(FieldOfView.cells_at),
              note="dots: cells that are projected; green: those in the image"),
        panel("threshold", _threshold, names["ground_columns"], name_of(vision_image),
              note="ground up to the line, by ratios of red"),
        panel("rocks", _rocks, names["rock_mask"], names["rock_detection"],
              note=f"{len(stages.sightings.x)} located"),
        panel("rover-centric", _rover_centric, names["evidence"],
              note="evidence of this frame, by certainty"),
        panel("world", _world, name_of(OccupancyMaps.world_map), names["rock_tracks"],
              note=f"{len(stages.frames)} frames, {free} m² navigable"),
        panel("polar arrays", _polar, names["nav_polar"], names["free_scan"], polar=True,
              note=f"{len(stages.result.nav.ranges)} ground cells; the line is the free scan"),
    )  # fmt: skip


def grid_lines(projection: GroundProjection) -> list[tuple[NDArray, NDArray]]:
    """Pixels (u, v) along each line of a grid of one metre on the ground."""
    aside = np.linspace(-GRID_ASIDE, GRID_ASIDE, 100)
    ahead = np.linspace(*GRID_AHEAD, 100)
    lines = [(np.full_like(aside, x), aside) for x in np.arange(GRID_AHEAD[0], GRID_AHEAD[1] + 1)]
    lines += [(ahead, np.full_like(ahead, y)) for y in np.arange(-GRID_ASIDE, GRID_ASIDE + 1)]
    return [projection.pixels(x, y)[:2] for x, y in lines]


def top_view(image: NDArray, projection: GroundProjection) -> tuple[NDArray, NDArray[np.bool_]]:
    """The image seen from above, and which points (rows, cols) of the ground it shows."""
    x = np.arange(AHEAD, 0.0, -STEP) - STEP / 2
    y = np.arange(ASIDE, -ASIDE, -STEP) - STEP / 2
    u, v, depth = projection.pixels(*np.meshgrid(x, y, indexing="ij"))
    height, width = image.shape[:2]
    inside = (depth > NEAREST_DEPTH) & (u >= 0) & (u < width) & (v >= 0) & (v < height)
    col = np.where(inside, u - 0.5, 0).astype(np.float32)
    row = np.where(inside, v - 0.5, 0).astype(np.float32)
    seen = cv2.remap(image, col, row, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(seen), inside


def _grid(ax: Axes, stages: OurStages) -> None:
    image_axes(ax, stages.image)
    for u, v in grid_lines(stages.projection):
        ax.plot(u, v, color=LINE, linewidth=0.7)
    columns = stages.segmentation.columns
    ax.plot(np.arange(len(columns.horizon)) + 0.5, columns.horizon, color="white", linewidth=0.7)
    for ahead in LABELLED:
        u, v, _ = stages.projection.pixels(np.array([ahead]), np.array([0.0]))
        ax.annotate(f"{ahead:g} m", (u[0] + 3, v[0] - 1), color="white", fontsize=7)


def _top_view(ax: Axes, stages: OurStages) -> None:
    seen, inside = top_view(stages.image, stages.projection)
    seen = np.where(inside[..., None], seen, np.uint8(235))
    show_on_ground(ax, seen, EXTENT)


def _field_of_view(ax: Axes, stages: OurStages) -> None:
    _, inside = top_view(stages.image, stages.projection)
    picture = np.where(inside[..., None], to_rgb(SEEN), to_rgb(FAINT))
    _, x, y = stages.field_of_view.cells_at(stages.pose)
    ax.plot(y, x, ".", color="black", markersize=0.8)
    show_on_ground(ax, picture, EXTENT)


def _threshold(ax: Axes, stages: OurStages) -> None:
    image_axes(ax, vision_image(stages.segmentation))
    reach = stages.segmentation.columns.reach
    ax.plot(np.arange(len(reach)) + 0.5, reach, color="white", linewidth=1.0)


def _rocks(ax: Axes, stages: OurStages) -> None:
    image_axes(ax, (stages.image * 0.45).astype(np.uint8))
    mask = stages.segmentation.rock_mask > 0
    marked = np.zeros((*mask.shape, 4))
    marked[mask] = (1.0, 0.9, 0.2, 1.0)
    height, width = mask.shape
    ax.imshow(marked, extent=(0, width, height, 0), interpolation="nearest")
    u, v, _ = stages.projection.pixels(stages.sightings.x, stages.sightings.y)
    ax.plot(u, v, "o", mfc="none", mec="white", markersize=14)


def _rover_centric(ax: Axes, stages: OurStages) -> None:
    cell, x, y = stages.field_of_view.cells_at(stages.pose)
    evidence: EvidenceGrid = stages.evidence
    for sums, color in ((evidence.blocked, OBSTACLE), (evidence.free_observations, GROUND)):
        weight = np.clip(sums.reshape(-1)[cell], 0.0, 1.0)
        colors = np.column_stack([np.tile(to_rgb(color), (len(cell), 1)), weight])
        ax.scatter(y, x, s=7, c=colors, marker="s", linewidths=0)
    ax.plot(stages.sightings.y, stages.sightings.x, **ROCKS)
    ground_axes(ax)


def _world(ax: Axes, stages: OurStages) -> None:
    map_axes(ax, stages.grid, stages.result.rocks, stages.pose)


def _polar(ax: Axes, stages: OurStages) -> None:
    polar_axes(ax, stages.result)
