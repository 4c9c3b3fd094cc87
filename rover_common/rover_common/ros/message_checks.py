"""Whether a message can be used, by its own content: before it takes the place of a good one."""

from __future__ import annotations

import math
from functools import singledispatch
from typing import Any

import numpy as np
from nav_msgs.msg import OccupancyGrid, Odometry
from rover_interfaces.msg import PolarArray, RockTrackArray
from sensor_msgs.msg import Image, LaserScan

from rover_common.ros import conversions
from rover_common.ros.conversions import MessageError

UNIT = 0.1  # that the length of a quaternion may differ from 1


@singledispatch
def check_message(message: Any) -> None:
    """Raises MessageError for one that cannot be used; other types than these have no checks."""


@check_message.register
def _(message: Odometry) -> None:
    q = message.pose.pose.orientation
    if abs(math.hypot(q.x, q.y, q.z, q.w) - 1.0) > UNIT:
        raise MessageError("the orientation is no unit quaternion")


@check_message.register
def _(message: Image) -> None:
    conversions.image_of(message)


@check_message.register
def _(message: PolarArray) -> None:
    ranges, bearings = len(message.ranges), len(message.bearings)
    if ranges != bearings:
        raise MessageError(f"{ranges} ranges and {bearings} bearings")


@check_message.register
def _(message: LaserScan) -> None:
    angles = message.angle_min, message.angle_increment
    if not len(message.ranges):
        raise MessageError("a scan without ranges")
    if not all(map(math.isfinite, angles)) or message.angle_increment <= 0.0:
        raise MessageError(f"a scan from {angles[0]} rad on in steps of {angles[1]} rad")
    if np.isnan(np.frombuffer(message.ranges, np.float32)).any():
        raise MessageError("a scan with ranges that are no numbers")


@check_message.register
def _(message: RockTrackArray) -> None:
    places = [(rock.position.x, rock.position.y, *rock.covariance) for rock in message.rocks]
    if not np.isfinite(places).all():
        raise MessageError("a rock without a place")


@check_message.register
def _(message: OccupancyGrid) -> None:
    info, cells = message.info, len(message.data)
    if not cells or info.width * info.height != cells:
        raise MessageError(f"a grid of {info.width} x {info.height} with {cells} cells")
    if not info.resolution > 0.0:
        raise MessageError(f"a grid with cells of {info.resolution} m")
