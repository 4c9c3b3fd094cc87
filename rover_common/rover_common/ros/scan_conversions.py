"""What is seen around base_link: dataclasses to messages and back; stamps are [ns]."""

from __future__ import annotations

from array import array

import numpy as np
from rover_interfaces.msg import PolarArray as PolarArrayMsg
from sensor_msgs.msg import LaserScan

from rover_common.frames import FRAMES, Frames
from rover_common.ros.conversions import header_of
from rover_common.types import FreeScan, PolarArray, Run


def polar_message_of(
    stamp: int, run: Run, polar: PolarArray, frames: Frames = FRAMES
) -> PolarArrayMsg:
    """In base_link."""
    return PolarArrayMsg(
        header=header_of(stamp, frames.base),
        run=run.number,
        ranges=_float32(polar.ranges),
        bearings=_float32(polar.bearings),
    )


def polar_of(message: PolarArrayMsg) -> PolarArray:
    """A read-only view of the message's arrays."""
    return PolarArray(
        np.frombuffer(message.ranges, np.float32), np.frombuffer(message.bearings, np.float32)
    )


def scan_message_of(stamp: int, scan: FreeScan, frames: Frames = FRAMES) -> LaserScan:
    """In base_link."""
    return LaserScan(
        header=header_of(stamp, frames.base),
        angle_min=scan.angle_min,
        angle_max=scan.angle_min + scan.angle_increment * (len(scan.ranges) - 1),
        angle_increment=scan.angle_increment,
        range_min=scan.range_min,
        range_max=scan.range_max,
        ranges=_float32(scan.ranges),
    )


def scan_of(message: LaserScan) -> FreeScan:
    """A read-only view of the message's ranges."""
    return FreeScan(
        message.angle_min,
        message.angle_increment,
        message.range_min,
        message.range_max,
        np.frombuffer(message.ranges, np.float32),
    )


def _float32(values: np.ndarray) -> array:
    return array("f", np.ascontiguousarray(values, np.float32).tobytes())
