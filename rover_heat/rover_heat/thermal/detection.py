"""Whether a frame shows heat, and in which direction: two rules, and the bearing of a patch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BURGER
from rover_heat.config import HeatConfig

PIXELS = BURGER.thermal_pixels
PIXEL = BURGER.thermal_field / PIXELS  # [rad] of one pixel, in both directions
AZIMUTHS = ((PIXELS - 1) / 2 - np.arange(PIXELS)) * PIXEL  # [rad] of the columns, left positive
CENTER = slice(2, 6)  # rows and columns of the 16 pixels that the absolute rule reads
WARM_SHARE = 0.25  # of the peak, above which a pixel belongs to the patch
REACH = 2  # [pixels] around the hottest one that count for the bearing


@dataclass(frozen=True)
class WarmPatch:
    """The hottest place of one frame."""

    azimuth: float  # [rad] from the sensor's axis, left positive
    peak: float  # [K] above the frame's median
    pixel: tuple[int, int]  # row and column of the hottest
    alone: bool  # no neighbour is warm: far away, or a pixel that is stuck
    cut: bool  # by the left or right border of the image: the bearing is not that of its middle


def find_patch(celsius: NDArray[np.float64], config: HeatConfig) -> WarmPatch | None:
    """What the frame (8, 8) [C] shows by the rule of the parameters; None where nothing is warm."""
    excess = celsius - np.median(celsius)
    if not _is_warm(celsius, excess, config):
        return None
    row, col = (int(i) for i in np.unravel_index(np.argmax(excess), excess.shape))
    peak = float(excess[row, col])
    around = excess[max(0, row - 1) : row + 2, max(0, col - 1) : col + 2]
    alone = int(np.count_nonzero(around > WARM_SHARE * peak)) == 1
    return WarmPatch(_azimuth(excess, row, col, peak), peak, (row, col), alone, _cut(col))


def _is_warm(celsius: NDArray[np.float64], excess: NDArray[np.float64], config: HeatConfig) -> bool:
    absolute = bool(celsius[CENTER, CENTER].max() >= config.temp_threshold)
    contrast = bool(excess.max() >= config.temp_contrast)
    if config.heat_rule == "both":
        return absolute and contrast
    return absolute if config.heat_rule == "absolute" else contrast


def _azimuth(excess: NDArray[np.float64], row: int, col: int, peak: float) -> float:
    """[rad] Mean of the warm pixels around the hottest, weighted by their excess.

    As many columns count to its left as to its right: a patch that reaches the border is not drawn
    towards the middle of the image.
    """
    reach = min(REACH, col, PIXELS - 1 - col)
    columns = slice(col - reach, col + reach + 1)
    rows = slice(max(0, row - REACH), row + REACH + 1)
    weights = np.maximum(excess[rows, columns] - WARM_SHARE * peak, 0.0).sum(axis=0)
    if not weights.any():  # the absolute rule, in a frame that is warm all over
        return float(AZIMUTHS[col])
    return float(weights @ AZIMUTHS[columns] / weights.sum())


def _cut(col: int) -> bool:
    return col in (0, PIXELS - 1)
