"""Whether a robot goes on where it was when a state was saved, as its odometry tells.

A robot without runs of its own has nothing else by which a saved state can be told from one of an
attempt before: it was carried back to its start, or its odometry began anew.
"""

from __future__ import annotations

from rover_common.burger import BURGER
from rover_common.geometry import Pose, distance_between
from rover_common.saved_state import StateError
from rover_common.sensor_types import Twist, WheelOdometry

# [s] of the robot's clock, after which a state is not used. A node that is started again is there
# within 10 s on a slow machine; who begins another attempt needs longer, to the start and back.
OLDEST = 60.0
MARGIN = 0.3  # [m] beyond what it can have driven: slip, or a pose that was found again


def check_goes_on(before: WheelOdometry, now: WheelOdometry) -> float:
    """[s] from the odometry of a saved state to that of now; raises StateError.

    Unless the one can follow the other: not earlier, not too late, and within reach.
    """
    seconds = (now.stamp - before.stamp) * 1e-9
    if seconds < 0.0:
        raise StateError(f"it is {-seconds:.1f} s newer than the odometry")
    if seconds > OLDEST:
        raise StateError(f"it is {seconds:.0f} s old, and at most {OLDEST:g} s may be missing")
    check_within_reach("odometry", before.pose, now.pose, seconds)
    return seconds


def check_within_reach(what: str, before: Pose, now: Pose, seconds: float) -> None:
    """Raises StateError where a robot cannot have driven from one pose to another so soon [s]."""
    away = distance_between(before, now)
    if not away <= BURGER.cruise_speed * seconds + MARGIN:
        raise StateError(f"another robot, or begun anew: the {what} is {away:.2f} m off")


def memory_of(odometry: WheelOdometry) -> list[float]:
    """For JSON."""
    pose, twist = odometry.pose, odometry.twist
    return [odometry.stamp, pose.x, pose.y, pose.yaw, twist.linear, twist.angular]


def odometry_of(memory: list[float]) -> WheelOdometry:
    """What `memory_of` gave; raises ValueError or TypeError for anything else."""
    stamp, x, y, yaw, linear, angular = memory
    pose, twist = Pose(float(x), float(y), float(yaw)), Twist(float(linear), float(angular))
    return WheelOdometry(int(stamp), pose, twist)
