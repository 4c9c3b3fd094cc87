"""The way to one goal: plans again and again, drives, recovers, and ends the goal."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BurgerModel
from rover_common.geometry import Pose
from rover_common.sensor_types import Twist
from rover_navigation.control.goal_driver import GoalDriver, Phase
from rover_navigation.control.mppi import Mppi
from rover_navigation.control.recoveries import Recoveries, Recovery
from rover_navigation.embedded_goal import EmbeddedGoal
from rover_navigation.navigator import GoalStatus
from rover_navigation.navigator_config import NavigatorConfig
from rover_navigation.path_planner import Ground
from rover_navigation.scale import Scale
from rover_navigation.types import NO_POINTS

BACK = 0.1  # [m] of ground behind that must be free to back off


class GoalRun:
    """Of one goal after the other."""

    def __init__(
        self,
        model: BurgerModel,
        scale: Scale,
        config: NavigatorConfig,
        generator: np.random.Generator,
    ) -> None:
        self._scale = scale
        self._config = config
        mppi = Mppi(model, config.samples, generator)
        self._driver = GoalDriver(model, scale.inflation, mppi)
        self._last = Twist()
        self._replan_at = -math.inf  # [s]
        self.path: NDArray[np.float64] = NO_POINTS
        self.why = ""

    def begin(self, goal: EmbeddedGoal) -> None:
        """Another goal."""
        self._goal = goal
        self._recoveries = Recoveries()
        self._ground: Ground | None = None
        self.path = NO_POINTS
        self.replan()
        self._driver.restart()

    def replan(self) -> None:
        """Plan at the next step, whenever the next plan were due."""
        self._replan_at = -math.inf

    def hold(self) -> None:
        """The robot is stopped for a reason that is no fault of the path; then it goes on."""
        self._recoveries.pause()
        self._last = Twist()
        self._driver.restart()
        self.replan()

    def step(
        self, stamp: int, pose: Pose, ground_at: Callable[[Pose], Ground], free_side: int
    ) -> Twist:
        """The velocity for the next period; the goal's status says how far it is."""
        time = stamp / 1e9
        recovery = self._recoveries.twist(time, self._may_back(pose))
        if recovery is not None:
            self._last = recovery
            return recovery
        self._goal.recovering = False
        if time >= self._replan_at:
            self._plan(time, pose, ground_at(pose))
        if len(self.path) == 0:
            return self._recover(time, pose, free_side, "no path to the goal")
        self._last = self._drive(pose)
        self.why = self._driver.phase.value
        if self._driver.phase is Phase.REACHED:
            self._goal.end(GoalStatus.REACHED)
        elif self._recoveries.stuck(time, pose):
            return self._recover(time, pose, free_side, "no progress")
        return self._last

    def _plan(self, time: float, pose: Pose, ground: Ground) -> None:
        goal = self._goal
        self._ground = ground
        self.path = ground.path(pose, goal.pose, goal.tolerance)
        self._replan_at = time + self._config.plan_period
        goal.status = GoalStatus.DRIVING

    def _drive(self, pose: Pose) -> Twist:
        assert self._ground is not None
        goal = self._goal
        tolerances = (goal.tolerance, self._config.yaw_tolerance)
        twist = self._driver.twist(
            pose, self._last, self._ground.costmap, self.path, goal.pose, tolerances
        )
        goal.distance_left = self._driver.distance_left
        return twist

    def _recover(self, time: float, pose: Pose, free_side: int, reason: str) -> Twist:
        """Begin the next recovery, or give up; the robot stops for this step."""
        self._last = Twist()
        self._driver.restart()
        self.replan()
        goal = self._goal
        if self._recoveries.exhausted(pose):
            goal.end(GoalStatus.FAILED, reason)
            return self._last
        self._recoveries.begin(time, pose, free_side)
        assert self._recoveries.active is not None
        self.why = f"{reason}: {self._recoveries.active.value}"
        goal.recovering = True
        goal.recoveries += 1
        return self._last

    def _may_back(self, pose: Pose) -> bool:
        """Whether the ground behind is free."""
        if self._recoveries.active is not Recovery.BACK or self._ground is None:
            return False
        x, y = pose.x - BACK * math.cos(pose.yaw), pose.y - BACK * math.sin(pose.yaw)
        costmap = self._ground.costmap
        row, col = (int(i) for i in costmap.geometry.nearest_cell_to(x, y))
        return bool(costmap.free[row, col] and costmap.clearance[row, col] >= self._scale.padding)
