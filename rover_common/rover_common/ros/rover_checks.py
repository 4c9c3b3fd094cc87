"""What this project's own messages must be like; see message_checks."""

from __future__ import annotations

from typing import Any

import numpy as np
from rover_interfaces.msg import (
    DriveCommand,
    HeatSourceArray,
    HeatState,
    MissionState,
    NavigationTick,
    PolarArray,
    RockTrackArray,
    RoverStatus,
    SensorTick,
)

from rover_common.ros.check_values import (
    FARTHEST,
    check_array,
    check_count,
    check_header,
    check_numbers,
    check_position,
    check_text,
    check_time,
    check_within,
)
from rover_common.ros.message_errors import RangeError, SizeError, StampError

MOST_ITEMS = 10_000  # rocks, sources
PEDAL = 1000.0  # of a throttle or a brake, which the bridge limits
FULL_TURN = 7.0  # [rad] no bearing and no steering angle is more
LONGEST = 1e9  # [s] and [m] of a mission


def check_polar(message: PolarArray) -> None:
    if len(message.ranges) != len(message.bearings):
        raise SizeError(f"{len(message.ranges)} ranges, {len(message.bearings)} bearings")
    check_header(message.header)
    check_array("range", message.ranges, np.float32, 0.0, FARTHEST)
    check_array("bearing", message.bearings, np.float32, -FULL_TURN, FULL_TURN)


def check_rocks(message: RockTrackArray) -> None:
    check_header(message.header)
    check_time(message.map_stamp)
    check_count("rocks", message.rocks, MOST_ITEMS)
    if len({rock.id for rock in message.rocks}) != len(message.rocks):
        raise RangeError("two rocks of one id")
    for rock in message.rocks:
        check_position(rock.position)
        _check_covariance(rock.covariance)
        check_time(rock.last_seen)


def check_sources(message: HeatSourceArray) -> None:
    check_header(message.header)
    check_count("sources", message.sources, MOST_ITEMS)
    for source in message.sources:
        check_position(source.position)
        _check_covariance(source.covariance)
        check_within("side", source.side, -FULL_TURN, FULL_TURN)
        check_within("peak", source.peak, -1000.0, 1000.0)


def check_status(message: RoverStatus) -> None:
    if len(message.sample_x) != len(message.sample_y):
        raise SizeError(f"{len(message.sample_x)} x, {len(message.sample_y)} y of samples")
    check_header(message.header)
    check_time(message.run_start)
    if _nanoseconds(message.run_start) > _nanoseconds(message.header.stamp):
        raise StampError("a run that begins after its telemetry")
    check_numbers("throttle or brake", message.throttle, message.brake)
    check_within("steering angle", message.steering_angle, -FULL_TURN * 2, FULL_TURN * 2)
    check_array("sample", message.sample_x, np.float64, -FARTHEST, FARTHEST)
    check_array("sample", message.sample_y, np.float64, -FARTHEST, FARTHEST)


def check_command(message: DriveCommand) -> None:
    check_header(message.header)
    check_time(message.frame_stamp)
    check_within("throttle", message.throttle, -PEDAL, PEDAL)
    check_within("brake", message.brake, -PEDAL, PEDAL)
    check_within("steering angle", message.steering_angle, -FULL_TURN, FULL_TURN)


def check_mission(message: MissionState | HeatState) -> None:
    check_header(message.header)
    check_text(message.state_name)
    check_text(message.reason)
    check_within("elapsed", message.elapsed, -LONGEST, LONGEST)
    check_within("explored", message.explored, 0.0, 1.0)
    check_within("distance", message.distance, 0.0, LONGEST)
    if isinstance(message, MissionState):
        check_within("distance to home", message.home_distance, 0.0, LONGEST)


def check_navigation_tick(message: NavigationTick) -> None:
    check_header(message.header)
    check_time(message.hazards)


def check_sensor_tick(message: SensorTick) -> None:
    check_header(message.header)


def _check_covariance(values: Any) -> None:
    """Of x and y, (4,) [m^2]."""
    check_array("covariance", values, np.float64, -FARTHEST, FARTHEST)
    if values[0] < 0.0 or values[3] < 0.0:
        raise RangeError("a negative variance")


def _nanoseconds(time: Any) -> int:
    return int(time.sec * 1_000_000_000 + time.nanosec)
