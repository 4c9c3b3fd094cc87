"""The rover's map, alone and against the truth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rover_common.map_encoding import navigable_cells
from rover_common.types import GridMap
from rover_tools.report.map_layers import (
    Drawing,
    Layer,
    Mark,
    Window,
    cells_path,
    map_layers,
    track_layers,
    window_around,
)
from rover_tools.report.mission_log import MissionLog

MARGIN = 4.0  # [m] around what is drawn


def drawing_of(log: MissionLog) -> Drawing:
    """Without a map, only the track."""
    samples = () if log.truth.samples is None else log.truth.samples.tolist()
    return Drawing(
        window_of(log),
        cells=() if log.grid is None else map_layers(log.grid),
        track=track_layers(log.track),
        start=(log.track[0].x, log.track[0].y) if log.track else None,
        marks=(
            *(Mark("sample", "circle", x, y, 2.2, "true sample") for x, y in samples),
            *(
                Mark("rock", "diamond", r.x, r.y, 1.1, f"rock, {r.observations} observations")
                for r in log.rocks
            ),
        ),
    )


def comparison_of(log: MissionLog) -> Drawing | None:
    """The same with the map against the truth, where there are both."""
    if log.grid is None or log.truth.navigable is None:
        return None
    return replace(drawing_of(log), cells=comparison_layers(log.grid, log.truth.navigable))


def window_of(log: MissionLog) -> Window:
    """All known cells, all true ground and the whole track."""
    xy = [np.array([(point.x, point.y) for point in log.track]).reshape(-1, 2)]
    if log.grid is not None:
        known = log.grid.cells >= 0
        if log.truth.navigable is not None:
            known = known | log.truth.navigable
        rows, cols = np.nonzero(known)
        corners = np.column_stack([cols, rows])
        corner = (log.grid.origin_x, log.grid.origin_y)
        xy += [corner + corners * log.grid.resolution]
        xy += [corner + (corners + 1) * log.grid.resolution]
    return window_around(np.concatenate(xy), MARGIN)


def comparison_layers(grid: GridMap, truth: NDArray[np.bool_]) -> tuple[Layer, ...]:
    """The map's navigable cells against the true ones, of the same shape."""
    navigable = navigable_cells(grid.cells)
    return (
        Layer("right", cells_path(navigable & truth, grid)),
        Layer("wrong", cells_path(navigable & ~truth, grid)),
        Layer("missing", cells_path(truth & ~navigable, grid)),
    )
