"""Which pixels show a rock sample, and how far the ground extends in each column of the image.

All colours were measured in the simulator's images.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_perception.camera.ground_projection import GroundProjection

# Ground ends at a pixel that is darker than this fraction of the ground below it in the image.
# Sand blended into a wall at a weight of 0.6 to 0.8 has 0.84 of the red of pure sand in the sun
# (202 of 241) and 0.82 in shadow (170 of 208); at 0.4 to 0.6 it has 0.62 and 0.64. The ratio is
# invariant to illumination. The value halfway between was selected on generated canyons.
GROUND_SHARE = 0.73
GROUND_BEFORE = (5, 31)  # [px] columns and rows over which the ground below a pixel is averaged
# Shadowed blends of 0.6 to 0.8 have red 170 +- 15, sky up to 163; walls 36 +- 19.
LEAST_RED = 150
# The red level that separates ground, by the mean red (index) of the ground below it.
LEVEL_AFTER = np.maximum(np.rint(GROUND_SHARE * np.arange(256)), LEAST_RED).astype(np.uint8)
# Sky at the image's lower edge: the camera is inside a wall, whose back faces are not drawn. In the
# recordings sky has blue at 0.89 of its red (5 to 95 %: 0.874 to 0.915) and red up to 189 (99 %);
# equally dark sand has 0.84, and 99.9 % of it less than 0.86. Brighter sand can be as grey as sky.
SKY_BLUE_OF_RED = 0.87
SKY_RED = 200
NEAREST_ROWS = 8  # [px] averaged, against the chroma blur of JPEG
# Yellow samples: blue is 0.08 (near) to 0.5 (12 m away) of green; sand 0.93, walls 0.84. JPEG
# stores chroma at half resolution, which spreads yellow onto the bright sand around a sample. The
# tinted sand is paler, and brighter (green 225 +- 18) than the sample itself (at most 194).
ROCK_BLUE_OF_GREEN = 0.65
# Rusty walls can have as little blue, but they are redder. A sample's green is 216/255 of its red
# by its albedo, 0.754 under the sun's tint, more with its own emission: the median in recordings
# is 0.845. 98 % of samples' pixels and 27 % of the walls' that are yellow enough exceed 0.75.
ROCK_GREEN_OF_RED = 0.75
ROCK_GREEN = (55, 200)  # darkest shaded side, brightest highlight

# Flat ground ends below the horizon. Ground that extends up to it lies on a slope that begins at an
# unknown distance, so only the nearest part of such a column is used.
SLOPE_MARGIN = 1.0  # [px]
SLOPE_RANGE = 4.0  # [m]
ABOVE_HORIZON = 3  # [px] searched above the horizon, to tell whether the ground continues


@dataclass(frozen=True)
class GroundColumns:
    """How far the ground extends in each column of the image, from the bottom up."""

    horizon: NDArray[np.floating]  # (width,) row of the horizon [px]
    reach: NDArray[np.floating]  # (width,) row where the ground ends [px], below the horizon
    blocked: NDArray[np.bool_]  # (width,) whether the ground ends at an obstacle


@dataclass(frozen=True)
class Segmentation:
    """One image and what its pixels show."""

    image: NDArray[np.uint8]  # (height, width, 3) RGB
    rock_mask: NDArray[np.uint8]  # (height, width) 255 on rock samples, else 0
    columns: GroundColumns
    projection: GroundProjection


def rock_mask(image: NDArray[np.uint8], projection: GroundProjection) -> NDArray[np.uint8]:
    """Pixels (height, width) of yellow samples: 255, else 0.

    Samples are lower than the camera, so rows entirely above the horizon are skipped.
    """
    mask = np.zeros(image.shape[:2], np.uint8)
    top = _first_row(projection, len(mask))
    red, green, blue = cv2.split(image[top:])
    yellow = cv2.compare(blue, cv2.convertScaleAbs(green, alpha=ROCK_BLUE_OF_GREEN), cv2.CMP_LT)
    cv2.bitwise_and(yellow, cv2.inRange(green, *ROCK_GREEN), dst=yellow)
    if cv2.countNonZero(yellow):  # in few frames
        rust = cv2.compare(green, cv2.convertScaleAbs(red, alpha=ROCK_GREEN_OF_RED), cv2.CMP_LT)
        yellow[rust > 0] = 0
        mask[top:] = yellow
    return mask


def ground_columns(
    image: NDArray[np.uint8], rocks: NDArray[np.uint8] | None, projection: GroundProjection
) -> GroundColumns:
    """Follow each column from its lowest pixel up to the first obstacle.

    `rocks` (height, width): pixels of samples, which count as ground because the rover drives over
    them. The row where the ground ends is interpolated between pixels.
    """
    height, width = image.shape[:2]
    horizon = projection.horizon(np.arange(width) + 0.5)
    top = _first_row(projection, height)
    red = np.asarray(cv2.medianBlur(np.ascontiguousarray(image[top:, :, 0]), 3), np.uint8)
    level = _ground_level(red)
    if rocks is not None:
        red[rocks[top:] > 0] = 255
    steps = _ground_rows(cv2.compare(red, level, cv2.CMP_LE))
    last = len(red) - steps  # uppermost ground row, counted from `top`
    edge = top + last + _blend(red, level, last)
    reach = np.where(steps == 0, float(height), edge)
    slope = reach < horizon + SLOPE_MARGIN
    near = horizon + projection.height * projection.camera.focal / SLOPE_RANGE
    reach = np.where(slope, np.maximum(reach, near), reach)
    sky = _sky_columns(image[-NEAREST_ROWS:])
    reach = np.where(sky, float(height), reach)
    return GroundColumns(horizon, np.maximum(reach, horizon + 0.5), ~(slope | sky))


def _sky_columns(nearest: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Columns (width,) whose nearest pixels (rows, width, 3) are sky; they carry no information."""
    mean = np.asarray(cv2.reduce(nearest, 0, cv2.REDUCE_AVG, dtype=cv2.CV_32F))[0]
    red, blue = mean[:, 0], mean[:, 2]
    return np.asarray((blue > SKY_BLUE_OF_RED * red) & (red < SKY_RED) & (red > LEAST_RED))


def _first_row(projection: GroundProjection, height: int) -> int:
    """The first row to search: a few above the horizon, where the ground may continue."""
    return min(max(math.floor(projection.highest_horizon) - ABOVE_HORIZON, 0), height - 2)


def _ground_rows(obstacle: NDArray[Any]) -> NDArray[np.intp]:
    """How many pixels (width,) of each column are ground below the first obstacle."""
    upwards = cv2.transpose(cv2.flip(obstacle, 0)) > 0
    steps = upwards.argmax(axis=1)
    blocked = upwards[np.arange(len(steps)), steps]
    return np.where(blocked, steps, upwards.shape[1])


def _ground_level(red: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The red (rows, width) above which a pixel is ground, from the mean of the rows below it."""
    before = cv2.blur(red, GROUND_BEFORE, anchor=(-1, 0), borderType=cv2.BORDER_REPLICATE)
    return np.asarray(cv2.LUT(before, LEVEL_AFTER), np.uint8)


def _blend(
    red: NDArray[np.uint8], level: NDArray[np.uint8], last: NDArray[np.intp]
) -> NDArray[np.floating]:
    """Where the red crosses the level between two pixel centres, from the pixels' edge [px]."""
    column = np.arange(red.shape[1])
    within, beyond = np.minimum(last, len(red) - 1), np.maximum(last - 1, 0)
    inside = red[within, column].astype(float)
    outside = red[beyond, column].astype(float)
    share = (level[beyond, column] - outside) / np.maximum(inside - outside, 1.0)
    return np.minimum(np.maximum(share, 0.0), 1.0) - 0.5
