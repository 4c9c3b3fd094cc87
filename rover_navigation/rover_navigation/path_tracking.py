"""Path tracking: pure pursuit, at the speed that curves, clearance and the vehicle allow."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, bearing_to
from rover_common.types import Command
from rover_navigation.actuation import COMFORT_DECELERATION, Actuation, approach_speed
from rover_navigation.local_clearance import LocalClearance
from rover_navigation.scale import Scale
from rover_navigation.types import Path

LOOKAHEAD_SECONDS = 0.8  # [s] of driving
CURVE_REACH = 2  # points before and after, between which a curve is measured
CURVE_MARGIN = 0.8  # of the vehicle's sharpest curve
# [m/s] The sharpest curve has a radius of 2.8 m at rest and of 3.4 m at this speed: to go slower
# gains little, and where even that is too wide, the robot turns in place.
CURVE_SPEED_MIN = 1.2
SHARP = math.radians(65.0)  # beyond, the robot turns in place
ALIGNED = math.radians(15.0)  # until here, once it is that slow
TURNING_SPEED = 0.3  # [m/s]
SPEED_MIN = 0.4  # [m/s] on a path


class PathTracker:
    """Tracks paths with one vehicle."""

    def __init__(self, actuation: Actuation, scale: Scale, top_speed: float) -> None:
        """top_speed [m/s] on open ground."""
        self._actuation = actuation
        self._scale = scale
        self._top_speed = top_speed

    def command(self, pose: Pose, speed: float, path: Path, local: LocalClearance) -> Command:
        """The command for this frame; the path must not be empty."""
        ahead = remaining(path, pose)
        scale = self._scale
        reach = LOOKAHEAD_SECONDS * abs(speed)
        reach = max(scale.lookahead_min, min(scale.lookahead_max, reach))
        x, y = _point_at(ahead.points, pose, reach)
        bearing, distance = bearing_to(pose, x, y), math.hypot(x - pose.x, y - pose.y)
        limit = ALIGNED if abs(speed) < TURNING_SPEED else SHARP
        if abs(bearing) > limit and distance > 0.3:
            return self._actuation.turn_in_place(speed, bearing)
        free = min(local.clearance(bearing), local.clearance(bearing / 2))
        in_sight = approach_speed(free - scale.stop_margin)
        target = min(self._top_speed, in_sight, self._speed_along(ahead, pose))
        curvature = 2.0 * math.sin(bearing) / max(distance, 0.5)
        return self._actuation.drive_curve(speed, max(SPEED_MIN, target), curvature)

    def bearing(self, pose: Pose, path: Path) -> float:
        """Bearing [rad] of the path a few steps ahead of the robot."""
        ahead = remaining(path, pose)
        return bearing_to(pose, *_point_at(ahead.points, pose, self._scale.lookahead_min))

    def at_end(self, pose: Pose, path: Path) -> bool:
        """Whether the robot has come to the path's last point."""
        x, y = path.points[-1]
        return math.hypot(x - pose.x, y - pose.y) < self._scale.path_end

    def _speed_along(self, path: Path, pose: Pose) -> float:
        """The speed now from which all limits ahead can still be met by gentle braking."""
        points = np.concatenate([[(pose.x, pose.y)], path.points])
        steps = np.hypot(*np.diff(points, axis=0).T)
        distance = np.cumsum(steps)
        near = distance < self._scale.horizon
        limit = np.minimum(path.speeds, self._curve_speeds(path.points))[near]
        allowed = np.sqrt(limit**2 + 2.0 * COMFORT_DECELERATION * distance[near])
        end = approach_speed(float(distance[-1])) if near.all() else math.inf
        return min(float(allowed.min(initial=math.inf)), end)

    def _curve_speeds(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Speed limit (n,) [m/s] at each point by the curve there: wheels turn less at speed."""
        model = self._actuation.vehicle
        speeds = np.full(len(points), model.max_speed)
        if len(points) <= 2 * CURVE_REACH:
            return speeds
        before = points[CURVE_REACH:-CURVE_REACH] - points[: -2 * CURVE_REACH]
        after = points[2 * CURVE_REACH :] - points[CURVE_REACH:-CURVE_REACH]
        cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        angle = np.abs(np.arctan2(cross, (before * after).sum(axis=1)))
        length = 0.5 * (np.hypot(*before.T) + np.hypot(*after.T))
        curvature = angle / np.maximum(length, 1e-3) / CURVE_MARGIN
        wheel = np.arctan(curvature * model.wheelbase / model.yaw_factor)
        loss = (model.wheel_at_rest - model.wheel_at_max_speed) / model.max_speed  # [rad s/m]
        limit = np.clip((model.wheel_at_rest - wheel) / loss, CURVE_SPEED_MIN, model.max_speed)
        speeds[CURVE_REACH:-CURVE_REACH] = limit
        return speeds


def remaining(path: Path, pose: Pose) -> Path:
    """The path from its point nearest to the robot on."""
    away = np.hypot(path.points[:, 0] - pose.x, path.points[:, 1] - pose.y)
    nearest = int(np.argmin(away))
    return Path(path.points[nearest:], path.speeds[nearest:])


def path_length(path: Path, pose: Pose) -> float:
    """What is left of a path [m], from the robot on."""
    steps = np.hypot(*np.diff(path.points, axis=0).T)
    return float(steps.sum()) + math.hypot(*(path.points[0] - (pose.x, pose.y)))


def _point_at(points: NDArray[np.float64], pose: Pose, reach: float) -> tuple[float, float]:
    """The first point at least `reach` [m] away, else the last."""
    far = np.flatnonzero(np.hypot(points[:, 0] - pose.x, points[:, 1] - pose.y) >= reach)
    x, y = points[far[0] if len(far) else -1]
    return float(x), float(y)
