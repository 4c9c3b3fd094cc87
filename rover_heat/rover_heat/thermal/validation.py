"""Validation of what a thermal sensor sends: 64 plausible temperatures, upright, or a reason."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rover_common.burger import BURGER
from rover_common.errors import RoverError

PIXELS = BURGER.thermal_pixels
LOWEST, HIGHEST = -20.0, 120.0  # [C] nothing here is colder or warmer
# The device's numbers have a sign bit; read without it, a small negative is 512 C less than itself.
WRAP = 512.0  # [C]

Celsius = NDArray[np.float64]


class ThermalFrameError(RoverError, ValueError):
    """A frame that cannot be used; its text says why."""


def valid_celsius(values: ArrayLike, flip: str) -> Celsius:
    """(8, 8) [C], row 0 on top, column 0 on the left; raises ThermalFrameError.

    values: 64 in any shape, row by row; flip: how the sensor is mirrored, one of FLIPS.
    """
    celsius = np.array(values, np.float64).ravel()
    if celsius.size != PIXELS * PIXELS:
        raise ThermalFrameError(f"{celsius.size} values, not {PIXELS * PIXELS}")
    if not np.isfinite(celsius).all():
        raise ThermalFrameError("a value is not a number")
    celsius[(celsius >= WRAP + LOWEST) & (celsius < WRAP)] -= WRAP
    if celsius.min() < LOWEST or celsius.max() > HIGHEST:
        raise ThermalFrameError(f"a value outside of {LOWEST:g} to {HIGHEST:g} C")
    frame = celsius.reshape(PIXELS, PIXELS)
    if flip in ("rows", "both"):
        frame = frame[::-1]
    if flip in ("columns", "both"):
        frame = frame[:, ::-1]
    return frame
