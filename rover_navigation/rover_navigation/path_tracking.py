"""Follow a way: pure pursuit, at the speed that bends, room and the vehicle allow."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, wrap_angle
from rover_common.types import Command
from rover_common.vehicle import MAX_SPEED, WHEELBASE
from rover_navigation import actuation as motion
from rover_navigation.local_clearance import Terrain
from rover_navigation.types import Way

LOOKAHEAD_SECONDS = 0.8  # [s] of driving
LOOKAHEAD = (1.2, 3.0)  # [m] least and most
BEND_REACH = 2  # points before and after, between which a bend is measured
HORIZON = 15.0  # [m] of the way that decides on the speed
BEND_MARGIN = 0.8  # of the vehicle's sharpest bend
# [m/s] The sharpest bend has a radius of 2.8 m at rest and of 3.4 m at this speed: to go slower
# gains little, and where even that is too wide, the rover turns on the spot.
BEND_SLOWEST = 1.2
SHARP = math.radians(65.0)  # beyond, the rover turns on the spot
ALIGNED = math.radians(15.0)  # until here, once it stands
STANDING = 0.3  # [m/s]
END_REACHED = 1.0  # [m]
STEP_DOWN = 0.4  # [m/s] slowest on a way


def follow(pose: Pose, speed: float, way: Way, terrain: Terrain, top_speed: float) -> Command:
    """The command for this frame; the way must not be empty."""
    ahead = remaining(way, pose)
    reach = float(np.clip(LOOKAHEAD_SECONDS * abs(speed), *LOOKAHEAD))
    bearing, distance = _towards(pose, _point_at(ahead.points, pose, reach))
    if abs(bearing) > (ALIGNED if abs(speed) < STANDING else SHARP) and distance > 0.3:
        return motion.turn_in_place(speed, bearing)
    free = min(terrain.clearance(bearing), terrain.clearance(bearing / 2))
    target = min(
        top_speed,
        motion.approach_speed(free - 0.8),
        _speed_along(ahead, pose),
    )
    curvature = 2.0 * math.sin(bearing) / max(distance, 0.5)
    return motion.drive_curve(speed, max(STEP_DOWN, target), curvature)


def remaining(way: Way, pose: Pose) -> Way:
    """The way from its point nearest to the rover on."""
    away = np.hypot(way.points[:, 0] - pose.x, way.points[:, 1] - pose.y)
    nearest = int(np.argmin(away))
    return Way(way.points[nearest:], way.speeds[nearest:])


def bearing_of(pose: Pose, way: Way) -> float:
    """Bearing [rad] of the way a few steps ahead of the rover."""
    ahead = remaining(way, pose)
    return _towards(pose, _point_at(ahead.points, pose, LOOKAHEAD[0]))[0]


def at_end(pose: Pose, way: Way) -> bool:
    """Whether the rover has come to the way's last point."""
    x, y = way.points[-1]
    return math.hypot(x - pose.x, y - pose.y) < END_REACHED


def bearing_to(pose: Pose, x: float, y: float) -> float:
    """[rad] left positive, of a point [m] in the map frame."""
    return wrap_angle(math.atan2(y - pose.y, x - pose.x) - pose.yaw)


def _point_at(points: NDArray[np.float64], pose: Pose, reach: float) -> NDArray[np.float64]:
    """The first point at least `reach` [m] away, else the last."""
    far = np.flatnonzero(np.hypot(points[:, 0] - pose.x, points[:, 1] - pose.y) >= reach)
    return np.asarray(points[far[0] if len(far) else -1])


def _towards(pose: Pose, point: NDArray[np.float64]) -> tuple[float, float]:
    dx, dy = float(point[0]) - pose.x, float(point[1]) - pose.y
    return wrap_angle(math.atan2(dy, dx) - pose.yaw), math.hypot(dx, dy)


def _speed_along(way: Way, pose: Pose) -> float:
    """The speed now from which all limits ahead can still be met by gentle braking."""
    points = np.concatenate([[(pose.x, pose.y)], way.points])
    steps = np.hypot(*np.diff(points, axis=0).T)
    distance = np.cumsum(steps)
    near = distance < HORIZON
    limit = np.minimum(way.speeds, _bend_speeds(way.points))[near]
    allowed = np.sqrt(limit**2 + 2.0 * motion.COMFORT_DECELERATION * distance[near])
    end = motion.approach_speed(float(distance[-1])) if near.all() else math.inf
    return min(float(allowed.min(initial=math.inf)), end)


def _bend_speeds(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Speed limit (n,) [m/s] at each point by the bend there: wheels turn less at speed."""
    speeds = np.full(len(points), MAX_SPEED)
    if len(points) <= 2 * BEND_REACH:
        return speeds
    before = points[BEND_REACH:-BEND_REACH] - points[: -2 * BEND_REACH]
    after = points[2 * BEND_REACH :] - points[BEND_REACH:-BEND_REACH]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    angle = np.abs(np.arctan2(cross, (before * after).sum(axis=1)))
    length = 0.5 * (np.hypot(*before.T) + np.hypot(*after.T))
    curvature = angle / np.maximum(length, 1e-3) / BEND_MARGIN
    wheel = np.degrees(np.arctan(curvature * WHEELBASE / motion.YAW_FACTOR))
    speeds[BEND_REACH:-BEND_REACH] = np.clip((15.0 - wheel) / 2.0, BEND_SLOWEST, MAX_SPEED)
    return speeds
