"""What a message must be before anything is made of it; all of them raise MessageError."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import Header

from rover_common.errors import RoverError

INVALID = "messages_invalid"  # counter in /diagnostics
LOG_PERIOD = 5.0  # [s] between two lines about dropped messages
UNIT_ERROR = 0.01  # of a quaternion's length
LEAST_RESOLUTION = 1e-4  # [m]
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


def check_points(ranges: np.ndarray, bearings: np.ndarray) -> None:
    """A bearing for each range, all of them finite."""
    if len(ranges) != len(bearings):
        raise MessageError(f"{len(ranges)} ranges and {len(bearings)} bearings")
    if not (np.isfinite(ranges).all() and np.isfinite(bearings).all()):
        raise MessageError("ranges or bearings that are not finite")


def check_distances(ranges: np.ndarray) -> None:
    """Not negative, and infinite where nothing is met."""
    if not (ranges >= 0.0).all():
        raise MessageError("ranges that are no distances")


def check_fan(message: LaserScan, ranges: np.ndarray) -> None:
    """Some bearings, one beside the other."""
    angles = message.angle_min, message.angle_increment
    check_finite("angles or limits", *angles, message.range_min, message.range_max)
    if len(ranges) == 0 or message.angle_increment == 0.0:
        raise MessageError(f"{len(ranges)} ranges, {message.angle_increment:g} rad apart")


def check_image(message: Image) -> None:
    """Pixels of rgb8 in rows of one length, which may be longer than the pixels."""
    height, width, step = message.height, message.width, message.step
    if message.encoding != "rgb8":
        raise ImageMessageError(f"image encoding '{message.encoding}', expected rgb8")
    if step < 3 * width or len(message.data) != height * step or not height * width:
        raise ImageMessageError("image data does not fit its height, width and step")


def check_grid(message: OccupancyGrid) -> None:
    """As many cells as it says, of some size, and not turned."""
    info, q = message.info, message.info.origin.orientation
    count = info.height * info.width
    if len(message.data) != count or not 0 < count <= MOST_CELLS:
        raise MessageError(f"{len(message.data)} cells, not {info.height} x {info.width}")
    origin = info.origin.position
    check_finite("resolution or origin", info.resolution, origin.x, origin.y)
    if info.resolution < LEAST_RESOLUTION or any((q.x, q.y, q.z)):
        raise MessageError(f"cells of {info.resolution:g} m, or a map that is turned")


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
