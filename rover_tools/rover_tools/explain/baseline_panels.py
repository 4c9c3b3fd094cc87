"""The baseline's stages as panels."""

from __future__ import annotations

import math
from collections.abc import Callable

import cv2
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from rover_common.map_encoding import navigable_cells
from rover_tools.explain.axes import (
    FAINT,
    GROUND,
    LINE,
    OBSTACLE,
    ROCK,
    SEEN,
    image_axes,
    map_axes,
    polar_axes,
    show_on_ground,
)  # fmt: skip
from rover_tools.explain.baseline_stages import (
    BOTTOM_OFFSET,
    CELLS_PER_METRE,
    NAMES,
    SQUARE,
    BaselineStages,
)
from rover_tools.explain.panels import Panel


def baseline_panels(stages: BaselineStages) -> tuple[Panel, ...]:
    """One for each stage, in their order."""
    count, rocks = len(stages.result.nav.ranges), int(np.count_nonzero(stages.rock))
    free = int(np.count_nonzero(navigable_cells(stages.grid.cells)))
    update = "level" if stages.updates else "tilted: this frame does not count"

    def panel(
        stage: str,
        draw: Callable[[Axes, BaselineStages], None],
        note: str = "",
        polar: bool = False,
    ) -> Panel:
        return Panel(stage, NAMES[stage], lambda ax: draw(ax, stages), note, polar)

    return (
        panel("grid", _grid, "from four points, the same at any pitch and roll"),
        panel("top view", _top_view, f"{CELLS_PER_METRE} cells a metre"),
        panel("field of view", _field_of_view, "where the warped image is"),
        panel("threshold", _threshold, "brightness, the same in sun and shadow"),
        panel("rocks", _rocks, f"{rocks} pixels, by limits of R, G and B"),
        panel("rover-centric", _rover_centric, f"nearer than {stages.most_range:g} m is mapped"),
        panel("world", _world, f"{update}; {free} m² navigable"),
        panel(
            "polar arrays", _polar, f"{count} ground pixels; the line is the free scan", polar=True
        ),
    )


def _grid(ax: Axes, stages: BaselineStages) -> None:
    """Lines of one metre in the top view, taken back into the image."""
    image_axes(ax, stages.image)
    back = np.linalg.inv(stages.warp)
    middle, height = stages.top_view.shape[1] / 2, stages.top_view.shape[0]
    bottom = height - BOTTOM_OFFSET
    along, across = np.linspace(0, 12, 100), np.linspace(-6, 6, 100)
    lines = [(across, np.full_like(across, x)) for x in range(13)]
    lines += [(np.full_like(along, y), along) for y in np.arange(-5.5, 6.0)]
    for y, x in lines:
        places = np.stack([middle + CELLS_PER_METRE * y, bottom - CELLS_PER_METRE * x], axis=1)
        pixels = cv2.perspectiveTransform(places[None].astype(np.float64), back)[0]
        ax.plot(*pixels.T, color=LINE, linewidth=0.7)
    ax.plot(*SQUARE[[0, 1, 2, 3, 0]].T, color="white", linewidth=1.6)


def _top_view(ax: Axes, stages: BaselineStages) -> None:
    view = np.where(stages.in_view[..., None], stages.top_view, np.uint8(235))
    show_on_ground(ax, view, _extent(stages))


def _field_of_view(ax: Axes, stages: BaselineStages) -> None:
    show_on_ground(ax, _coloured(stages, (stages.in_view, SEEN)), _extent(stages))


def _threshold(ax: Axes, stages: BaselineStages) -> None:
    classes = (stages.obstacle, OBSTACLE), (stages.ground, GROUND)
    show_on_ground(ax, _coloured(stages, *classes), _extent(stages))


def _rocks(ax: Axes, stages: BaselineStages) -> None:
    view = np.where(stages.in_view[..., None], stages.top_view * 0.45, 235).astype(np.uint8)
    view[stages.rock] = (255, 230, 60)
    show_on_ground(ax, view, _extent(stages))


def _rover_centric(ax: Axes, stages: BaselineStages) -> None:
    classes = (stages.obstacle, OBSTACLE), (stages.ground, GROUND), (stages.rock, ROCK)
    show_on_ground(ax, _coloured(stages, *classes), _extent(stages))
    angle = np.linspace(0, math.pi, 100)
    ax.plot(
        stages.most_range * np.cos(angle),
        stages.most_range * np.sin(angle),
        color="black",
        linewidth=1.0,
    )


def _world(ax: Axes, stages: BaselineStages) -> None:
    map_axes(ax, stages.grid, stages.result.rocks, stages.pose)


def _polar(ax: Axes, stages: BaselineStages) -> None:
    polar_axes(ax, stages.result)


def _extent(stages: BaselineStages) -> tuple[float, float, float, float]:
    height, width = stages.in_view.shape
    aside = width / 2 / CELLS_PER_METRE
    return aside, -aside, 0.0, height / CELLS_PER_METRE


def _coloured(
    stages: BaselineStages, *classes: tuple[NDArray[np.bool_], str]
) -> NDArray[np.floating]:
    """A picture of the top view in the colours of its classes, the later ones on top."""
    picture = np.full((*stages.in_view.shape, 3), to_rgb(FAINT))
    for mask, color in classes:
        picture[mask] = to_rgb(color)
    return picture
