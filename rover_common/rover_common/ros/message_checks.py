"""What a message must be before anything is made of it; all of them raise MessageError."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from geometry_msgs.msg import Quaternion
from rclpy.node import Node
from std_msgs.msg import Header

from rover_common.errors import RoverError

INVALID = "messages_invalid"  # counter in /diagnostics
LOG_PERIOD = 5.0  # [s] between two lines about dropped messages
UNIT_ERROR = 0.01  # of a quaternion's length
MOST_CELLS = 16_000_000  # of a grid: 1 km x 1 km in cells of 0.25 m

M = TypeVar("M")


class MessageError(RoverError, ValueError):
    """A message that cannot be used: wrong size, encoding, frame or numbers."""

    counter = INVALID


class ImageMessageError(MessageError):
    """One of an image."""

    counter = "frame_image_encoding"


def check_finite(what: str, *values: float) -> None:
    if not all(map(math.isfinite, values)):
        raise MessageError(f"{what}: {', '.join(f'{value:g}' for value in values)}")


def check_all_finite(what: str, values: np.ndarray) -> None:
    if not np.isfinite(values).all():
        raise MessageError(f"{what} that are not finite")


def check_unit(q: Quaternion) -> None:
    """One of another length is no rotation; what is not a number makes the pose none either."""
    length = math.hypot(q.x, q.y, q.z, q.w)
    if not math.isnan(length) and abs(length - 1.0) > UNIT_ERROR:
        raise MessageError(f"an orientation of length {length:.3g}, not 1")


def check_frame(header: Header, *frames: str) -> None:
    """One of these frames, with a prefix or without; an empty name is taken for the right one."""
    name = header.frame_id.rpartition("/")[2]
    if name and name not in frames:
        raise MessageError(f"frame '{header.frame_id}', expected {' or '.join(frames)}")


def guarded(node: Node, counts: Counter[str], callback: Callable[[M], Any]) -> Callable[[M], None]:
    """A subscription's callback: what it cannot use is dropped, counted and told."""

    def take(message: M) -> None:
        try:
            callback(message)
        except MessageError as error:
            counts[error.counter] += 1
            kind = type(message).__name__
            node.get_logger().warning(f"{kind} dropped: {error}", throttle_duration_sec=LOG_PERIOD)

    return take
