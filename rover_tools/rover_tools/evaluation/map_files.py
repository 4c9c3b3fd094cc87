"""Write a world map: as a map_server pair, and as a picture beside the truth."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import BinaryIO

import cv2
import numpy as np
import yaml
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import GridMap, RockTrack
from rover_common.whole_file import whole_file, write_whole

# map_server's pixel values in trinary mode
FREE, UNKNOWN, OCCUPIED = 254, 205, 0

WHITE, GREY, DARK = "#ffffff", "#d9d9d9", "#555555"
GREEN, RED, BLUE, YELLOW = "#6baf6b", "#d7443e", "#2b6cb0", "#f2c500"


def save_map_server_pair(grid: GridMap, stem: Path) -> None:
    """Write `<stem>.pgm` and `<stem>.yaml`, as nav2's map_server loads them."""
    image = np.full(grid.cells.shape, UNKNOWN, np.uint8)
    image[grid.cells > EDGE] = OCCUPIED
    image[navigable_cells(grid.cells)] = FREE
    # The file's first row is the north edge, the grid's is the south edge.
    write_whole(stem.with_suffix(".pgm"), cv2.imencode(".pgm", image[::-1])[1].tobytes())
    description = {
        "image": stem.with_suffix(".pgm").name,
        "mode": "trinary",
        "resolution": float(grid.resolution),
        "origin": [float(grid.origin_x), float(grid.origin_y), 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }
    write_whole(stem.with_suffix(".yaml"), yaml.safe_dump(description, sort_keys=False))


def draw_map(
    file: Path | BinaryIO,
    grid: GridMap,
    track: NDArray[np.float64],
    rocks: Sequence[RockTrack],
    truth: NDArray[np.bool_] | None,
    samples: NDArray[np.float64] | None,
    title: str,
) -> None:
    """Draw the map as PNG, with the truth beside it where there is one.

    track: (n, 2) driven positions [m]; truth: (200, 200) navigable cells; samples: (m, 2) true
    positions [m].
    """
    navigable = navigable_cells(grid.cells)
    panels = 1 if truth is None else 2
    figure = Figure(figsize=(6.2 * panels, 6.6), dpi=110, layout="constrained")
    axes = figure.subplots(1, panels, squeeze=False)[0]
    height, width = grid.cells.shape
    extent = (
        grid.origin_x,
        grid.origin_x + width * grid.resolution,
        grid.origin_y,
        grid.origin_y + height * grid.resolution,
    )
    classes = np.select([navigable, grid.cells > EDGE], [1, 2], 0)
    _show(axes[0], classes, [GREY, WHITE, DARK], ["unknown", "navigable", "obstacle"], extent)
    axes[0].set_title("map")
    if truth is not None:
        compared = np.select([navigable & truth, navigable, truth], [1, 2, 3], 0)
        colors, labels = [WHITE, GREEN, RED, GREY], ["", "right", "wrong", "not mapped"]
        _show(axes[1], compared, colors, labels, extent)
        axes[1].set_title("map against the truth")
    for ax in axes:
        ax.plot(track[:, 0], track[:, 1], color=BLUE, linewidth=0.9)
        ax.plot(*track[:1].T, marker="o", color=BLUE, markersize=5)
        if samples is not None and len(samples):
            ax.plot(*samples.T, "o", mfc="none", mec="black", markersize=9)
        if rocks:
            xy = [(rock.x, rock.y) for rock in rocks]
            ax.plot(*np.transpose(xy), "D", color=YELLOW, mec="black", mew=0.5, markersize=5)
        _zoom(ax, classes, truth, extent)
    figure.suptitle(title)
    _save(figure, file)


def _save(figure: Figure, file: Path | BinaryIO) -> None:
    if not isinstance(file, Path):
        figure.savefig(file, format="png")
        return
    with whole_file(file) as draft:
        figure.savefig(draft, format="png")


def _show(ax: Axes, classes: NDArray, colors: list[str], labels: list[str], extent: tuple) -> None:
    cmap = ListedColormap(colors)
    ax.imshow(
        classes, origin="lower", extent=extent, cmap=cmap, vmin=0, vmax=len(colors) - 1,
        interpolation="nearest",
    )  # fmt: skip
    keys = [Patch(fc=c, ec="black", label=n) for c, n in zip(colors, labels, strict=True) if n]
    ax.legend(handles=keys, loc="upper right", fontsize=8)
    ax.set_xlabel("x (east) [m]")
    ax.set_ylabel("y (north) [m]")


def _zoom(ax: Axes, classes: NDArray, truth: NDArray[np.bool_] | None, extent: tuple) -> None:
    """Cut the empty margin away."""
    seen = classes > 0 if truth is None else (classes > 0) | truth
    rows, cols = np.nonzero(seen)
    if len(rows) == 0:
        return
    resolution = (extent[1] - extent[0]) / classes.shape[1]
    margin = 5.0
    ax.set_xlim(
        extent[0] + cols.min() * resolution - margin, extent[0] + cols.max() * resolution + margin
    )
    ax.set_ylim(
        extent[2] + rows.min() * resolution - margin, extent[2] + rows.max() * resolution + margin
    )
