"""Drives along a path to a goal: turns to the path, follows it, turns to the goal's heading."""

from __future__ import annotations

import math
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BurgerModel
from rover_common.geometry import Pose, bearing_to, wrap_angle
from rover_common.sensor_types import Twist
from rover_navigation.control.critics import Scene
from rover_navigation.control.mppi import Mppi
from rover_navigation.costmap import Costmap

SHARP, ALIGNED = math.radians(70.0), math.radians(20.0)  # a turn in place begins, and ends
AIM = 0.2  # [m] along the path to the point that decides on it
AHEAD = 0.6  # [m] of the path that count: what is reached in the controller's horizon, and more
TURN_GAIN, TURN_LEAST = 2.5, 0.15  # [1/s], [rad/s] of turns in place
CLOSE_ENOUGH = 0.4  # of the tolerance, at which it stops to come nearer
# [m] from the goal, within which nearness to walls counts less and less: what makes a robot pass
# them at a distance would keep it away from a goal between them
NEAR_GOAL = 0.5
CLOSER = 0.003  # [m] to come nearer by, lest it counts as near as it gets


class Phase(Enum):
    ALIGN = "turning towards the path"
    FOLLOW = "following the path"
    FINAL_TURN = "turning to the goal's heading"
    REACHED = "reached"


class GoalDriver:
    """One goal after the other; `restart` before each."""

    def __init__(self, model: BurgerModel, inflation: float, mppi: Mppi) -> None:
        """inflation [m] from obstacles up to which ground costs more."""
        self._model = model
        self._inflation = inflation
        self._mppi = mppi
        self.restart()

    def restart(self) -> None:
        """Another goal, or a robot that was stopped."""
        self.distance_left = math.inf  # [m] along the path
        self.phase = Phase.FOLLOW
        self._nearest = math.inf  # [m] from the goal so far, within the tolerance
        self._mppi.restart()

    def twist(
        self, pose: Pose, last: Twist, costmap: Costmap, path: NDArray[np.float64], goal: Pose,
        tolerances: tuple[float, float],
    ) -> Twist:  # fmt: skip
        """The velocity for the next period; zero once reached.

        path (n, 2) [m], not empty, from where the robot was when it was planned; tolerances:
        [m], [rad]; last: the velocity that was told before.
        """
        first = nearest_index(path, pose)
        ahead = path[first:]
        steps = np.hypot(*np.diff(ahead, axis=0).T)
        self.distance_left = math.dist((pose.x, pose.y), ahead[0]) + float(steps.sum())
        ahead = ahead[: 1 + int(np.count_nonzero(np.cumsum(steps) <= AHEAD))]
        self._choose_phase(pose, goal, tolerances, ahead)
        if self.phase is Phase.FINAL_TURN:
            return self._turn(wrap_angle(goal.yaw - pose.yaw))
        if self.phase is Phase.ALIGN:
            return self._turn(_bearing_along(ahead, pose))
        if self.phase is Phase.REACHED or len(ahead) < 2:
            return Twist()
        path_ahead = ahead.astype(np.float32)
        caution = min(1.0, self.distance_left / NEAR_GOAL)
        scene = Scene(costmap, path_ahead, self._model.body_radius, self._inflation, caution)
        return self._mppi.twist(pose, last, scene)

    def _choose_phase(
        self, pose: Pose, goal: Pose, tolerances: tuple[float, float], ahead: NDArray[np.float64]
    ) -> None:
        distance = math.dist((pose.x, pose.y), (goal.x, goal.y))
        tolerance, yaw_tolerance = tolerances
        if distance > tolerance:
            self._nearest = math.inf
            if self.phase in (Phase.FINAL_TURN, Phase.REACHED):
                self.phase = Phase.FOLLOW
        elif self.phase in (Phase.FOLLOW, Phase.ALIGN):
            near = distance < CLOSE_ENOUGH * tolerance
            if near or distance > self._nearest - CLOSER:
                self.phase = Phase.FINAL_TURN
            self._nearest = min(self._nearest, distance)
        if self.phase is Phase.FINAL_TURN:
            if abs(wrap_angle(goal.yaw - pose.yaw)) < yaw_tolerance:
                self.phase = Phase.REACHED
            return
        turn = abs(_bearing_along(ahead, pose))
        if self.phase is Phase.FOLLOW and turn > SHARP:
            self.phase = Phase.ALIGN
            self._mppi.restart()
        elif self.phase is Phase.ALIGN and turn < ALIGNED:
            self.phase = Phase.FOLLOW

    def _turn(self, angle: float) -> Twist:
        rate = min(self._model.cruise_turn, max(TURN_LEAST, TURN_GAIN * abs(angle)))
        return Twist(0.0, math.copysign(rate, angle))


def nearest_index(path: NDArray[np.float64], pose: Pose) -> int:
    """Of the point of a path (n, 2) [m] that is nearest to the robot.

    Only its beginning is tried: a path may come back on the other side of a thin wall.
    """
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    near = path[along <= AHEAD]
    return int(np.argmin(np.hypot(near[:, 0] - pose.x, near[:, 1] - pose.y)))


def _bearing_along(ahead: NDArray[np.float64], pose: Pose) -> float:
    """[rad] to a point on the path; 0 where the path ends here."""
    far = np.hypot(ahead[:, 0] - pose.x, ahead[:, 1] - pose.y) >= AIM
    if not far.any():
        return 0.0
    x, y = ahead[int(np.argmax(far))]
    return bearing_to(pose, float(x), float(y))
