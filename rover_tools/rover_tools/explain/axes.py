"""Axes that all panels share: the camera's image, the ground around the rover, the map, polar."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.ticker import MultipleLocator
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import GridMap, PerceptionResult, RockTrack
from rover_tools.evaluation.map_files import BLUE, DARK, GREY, RED, WHITE, YELLOW

AHEAD, ASIDE = 10.0, 8.0  # [m] of the ground that the panels show
MAP_MARGIN = 18.0  # [m] of the map around the rover
GROUND, OBSTACLE, ROCK, ROVER, LINE = BLUE, RED, YELLOW, "black", "#00e5ff"
ROCKS: dict[str, Any] = {"ls": "", "marker": "D", "color": ROCK, "mec": "black", "markersize": 6}
FAINT, SEEN = "#ebebeb", "#aed9ae"  # outside of the field of view, and inside


def image_axes(ax: Axes, image: NDArray[np.uint8]) -> None:
    """Pixel coordinates are continuous: pixel (0, 0) spans 0 to 1."""
    height, width = image.shape[:2]
    ax.imshow(image, extent=(0, width, height, 0))
    ax.set(xlim=(0, width), ylim=(height, 0), xticks=(), yticks=())


def ground_axes(ax: Axes) -> None:
    """The ground from above, the rover below the middle: left is left."""
    ax.set(xlim=(ASIDE, -ASIDE), ylim=(0, AHEAD), aspect="equal")
    ax.set_xlabel("y (left) [m]", fontsize=7)
    ax.set_ylabel("x (ahead) [m]", fontsize=7)
    ax.tick_params(labelsize=7)
    ax.plot(0, 0.15, "^", color=ROVER, markersize=7, clip_on=False)


def map_axes(ax: Axes, grid: GridMap, rocks: Sequence[RockTrack], pose: Pose) -> None:
    """The map around the rover, north up; the line shows where the rover heads."""
    classes = np.select([navigable_cells(grid.cells), grid.cells > EDGE], [1, 2], 0)
    rows, cols = np.multiply(grid.cells.shape, grid.resolution)
    ax.imshow(
        classes, origin="lower", vmin=0, vmax=2, cmap=ListedColormap([GREY, WHITE, DARK]),
        extent=(grid.origin_x, grid.origin_x + cols, grid.origin_y, grid.origin_y + rows),
        interpolation="nearest",
    )  # fmt: skip
    ax.plot([rock.x for rock in rocks], [rock.y for rock in rocks], **ROCKS)
    ax.plot(pose.x, pose.y, "o", color=ROVER, markersize=5)
    ahead = 2.5 * math.cos(pose.yaw), 2.5 * math.sin(pose.yaw)
    ax.plot([pose.x, pose.x + ahead[0]], [pose.y, pose.y + ahead[1]], color=ROVER, linewidth=1.5)
    ax.set(
        xlim=(pose.x - MAP_MARGIN, pose.x + MAP_MARGIN),
        ylim=(pose.y - 0.6 * MAP_MARGIN, pose.y + 0.6 * MAP_MARGIN), aspect="equal",
    )  # fmt: skip
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MultipleLocator(5.0))
    ax.set_xlabel("x (east) [m]", fontsize=7)
    ax.set_ylabel("y (north) [m]", fontsize=7)
    ax.tick_params(labelsize=7)


def polar_axes(ax: Any, result: PerceptionResult) -> None:
    """Ground and rocks by range and bearing; ahead is up, bearings are left positive."""
    ax.set_theta_zero_location("N")
    ax.set_thetamin(-60)
    ax.set_thetamax(60)
    ax.tick_params(labelsize=7)
    nav, rock, scan = result.nav, result.rock, result.scan
    ax.plot(nav.bearings, nav.ranges, ".", color=GROUND, markersize=1.5, alpha=0.5)
    bearings = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
    ranges = np.where(np.isfinite(scan.ranges), scan.ranges, np.nan)  # free farther than mapped
    ax.plot(bearings, ranges, color="black", linewidth=1.0)
    ax.plot(rock.bearings, rock.ranges, **ROCKS)
    ax.set_rlim(0, scan.range_max)


def show_on_ground(
    ax: Axes, picture: NDArray, extent: tuple[float, float, float, float], **options: Any
) -> None:
    """A picture from above; extent [m]: y of its left and right edge, x of its lower and upper."""
    ax.imshow(picture, extent=extent, interpolation="nearest", **options)
    ground_axes(ax)
