"""Publishes messages that no node of ours sends, from a node in the run's own domain."""

from __future__ import annotations

import math
import time
from array import array
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock
from rover_interfaces.msg import DriveCommand, PolarArray, RockTrack, RockTrackArray
from sensor_msgs.msg import Image, LaserScan

from rover_common import frames, topics
from rover_common.ros import conversions, qos
from rover_tools.chaos.graph_shapes import GraphShape
from rover_tools.runner.node_in_domain import NodeInDomain

CLOCK = "/clock"
PERIOD = 0.05  # [s] between two messages
MOST = 60  # messages of one fault
DISCOVERY = 3.0  # [s] of wall time for a subscriber to be found
FAR = 2_000_000_000  # [s] of a clock that nobody has
NAN = math.nan


class Junk(NamedTuple):
    """Messages of a topic; `make` takes the stamp [ns]."""

    topic: str
    profile: QoSProfile
    make: Callable[[int], Any]


_in_base = partial(conversions.header_of, frame=frames.BASE)
_in_map = partial(conversions.header_of, frame=frames.MAP)


def _empty_scan(stamp: int) -> LaserScan:
    return LaserScan(header=_in_base(stamp))


def _scan_of_nan(stamp: int) -> LaserScan:
    ranges = array("f", [NAN] * 31)
    return LaserScan(header=_in_base(stamp), angle_increment=NAN, range_max=NAN, ranges=ranges)


def _grid_without_cells(stamp: int) -> OccupancyGrid:
    return OccupancyGrid(header=_in_map(stamp))


def _grid_of_another_size(stamp: int) -> OccupancyGrid:
    grid = OccupancyGrid(header=_in_map(stamp), data=array("b", [0] * 10))
    grid.info.width, grid.info.height, grid.info.resolution = 1_000_000, 3, -1.0
    return grid


def _zero_quaternion(stamp: int) -> Odometry:
    odometry = Odometry(header=conversions.header_of(stamp, frames.ODOM))
    odometry.pose.pose.orientation.w = 0.0
    return odometry


def _no_pixels(stamp: int) -> Image:
    return Image(header=_in_base(stamp), encoding="rgb8", height=160, width=320)


def _unequal_arrays(stamp: int) -> PolarArray:
    return PolarArray(header=_in_base(stamp), ranges=array("f", [1.0, 2.0, 3.0]))


def _rock_at_nan(stamp: int) -> RockTrackArray:
    rock = RockTrack(id=7, observations=9)
    rock.position.x = NAN
    return RockTrackArray(header=_in_map(stamp), rocks=[rock])


def _clock_at_zero(_: int) -> Clock:
    return Clock()


def _clock_far_ahead(_: int) -> Clock:
    return Clock(clock=conversions.time_of(FAR * conversions.NANOSECONDS))


def _command_of_nan(stamp: int) -> DriveCommand:
    stamped = conversions.time_of(stamp)
    return DriveCommand(header=_in_base(stamp), frame_stamp=stamped, throttle=NAN)


JUNK: Mapping[GraphShape, Junk] = {
    GraphShape.EMPTY_SCAN: Junk(topics.FREE_SCAN, qos.FRAME, _empty_scan),
    GraphShape.SCAN_OF_NAN: Junk(topics.FREE_SCAN, qos.FRAME, _scan_of_nan),
    GraphShape.GRID_WITHOUT_CELLS: Junk(topics.NAVIGATION_MAP, qos.LATCHED, _grid_without_cells),
    GraphShape.GRID_OF_ANOTHER_SIZE: Junk(
        topics.NAVIGATION_MAP, qos.LATCHED, _grid_of_another_size
    ),
    GraphShape.ZERO_QUATERNION: Junk(topics.ODOMETRY, qos.FRAME, _zero_quaternion),
    GraphShape.NO_PIXELS: Junk(topics.IMAGE, qos.FRAME, _no_pixels),
    GraphShape.UNEQUAL_ARRAYS: Junk(topics.NAV_POLAR, qos.FRAME, _unequal_arrays),
    GraphShape.ROCK_AT_NAN: Junk(topics.ROCKS, qos.FRAME_LATCHED, _rock_at_nan),
    GraphShape.CLOCK_AT_ZERO: Junk(CLOCK, qos.CLOCK, _clock_at_zero),
    GraphShape.CLOCK_FAR_AHEAD: Junk(CLOCK, qos.CLOCK, _clock_far_ahead),
    GraphShape.COMMAND_OF_NAN: Junk(topics.COMMAND, qos.FRAME, _command_of_nan),
}


class GraphFaults(NodeInDomain):
    """Used by one thread at a time."""

    def __init__(self, domain_id: int) -> None:
        super().__init__("faults", domain_id)

    def publish(self, newest: Callable[[], int], shape: str, stopped: Callable[[], bool]) -> int:
        """Messages of the shape until stopped; how many.

        newest: the stamp [ns] of the frame in progress, which every other message claims to be of;
        the others have the stamp zero.
        """
        junk = JUNK[GraphShape(shape)]
        make = junk.make
        publisher = self.node.create_publisher(type(make(0)), junk.topic, junk.profile)
        try:
            end = time.monotonic() + DISCOVERY
            while publisher.get_subscription_count() == 0 and time.monotonic() < end:
                time.sleep(PERIOD)
            for sent in range(MOST):
                if stopped():
                    return sent
                publisher.publish(make(newest() if sent % 2 else 0))
                time.sleep(PERIOD)
            return MOST
        finally:
            self.node.destroy_publisher(publisher)
