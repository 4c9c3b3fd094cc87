"""The parts that messages are made of, checked; each function raises a MessageError."""

from __future__ import annotations

import math
from collections.abc import Sized
from typing import Any

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Quaternion, Vector3
from numpy.typing import DTypeLike
from std_msgs.msg import Header

from rover_common.ros.message_errors import (
    FrameError,
    NotFiniteError,
    RangeError,
    RotationError,
    SizeError,
    StampError,
)

FARTHEST = 1e6  # [m] of anything from the origin of its frame
UNIT = 0.01  # that the square of a quaternion's length may be off 1, as tf2 has it
MOST_CHARACTERS = 10_000
FRAME_CHARACTERS = 256


def check_numbers(what: str, *values: float) -> None:
    if not all(map(math.isfinite, values)):
        raise NotFiniteError(f"{what} is not finite")


def check_within(what: str, value: float, low: float, high: float) -> None:
    check_numbers(what, value)
    if not low <= value <= high:
        raise RangeError(f"{what} is {value:g}, not {low:g} to {high:g}")


def check_array(what: str, values: Any, dtype: DTypeLike, low: float, high: float) -> None:
    """values: a buffer of such numbers."""
    array = np.frombuffer(values, dtype)
    if not len(array):
        return
    least, most = float(array.min()), float(array.max())
    check_numbers(f"a {what}", least, most)
    if least < low or most > high:
        raise RangeError(f"a {what} of {least:g} to {most:g}, not {low:g} to {high:g}")


def check_count(what: str, values: Sized, most: int) -> None:
    if len(values) > most:
        raise SizeError(f"{len(values)} {what}, more than {most}")


def check_text(text: str) -> None:
    if len(text) > MOST_CHARACTERS:
        raise SizeError(f"a text of {len(text)} characters")


def check_time(time: Time) -> None:
    if time.sec < 0 or time.nanosec >= 1_000_000_000:
        raise StampError(f"{time.sec} s and {time.nanosec} ns are no time")


def check_header(header: Header) -> None:
    check_time(header.stamp)
    name = header.frame_id
    if len(name) > FRAME_CHARACTERS or name != "".join(name.split()):
        raise FrameError(f"'{name:.40}' is no name of a frame")


def check_position(at: Point | Vector3) -> None:
    for value in (at.x, at.y, at.z):
        check_within("a coordinate", value, -FARTHEST, FARTHEST)


def check_rotation(q: Quaternion) -> None:
    check_numbers("a rotation", q.x, q.y, q.z, q.w)
    length = math.hypot(q.x, q.y, q.z, q.w)
    if not abs(length * length - 1.0) <= UNIT:
        raise RotationError(f"a quaternion of length {length:.3g}")
