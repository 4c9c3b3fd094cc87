"""The navigator of its own: localisation, map, planner and controller in one step, without ROS."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BurgerModel
from rover_common.geometry import Pose, compose
from rover_common.saved_state import Memory
from rover_common.sensor_types import SensorBatch, Twist
from rover_common.types import GridMap
from rover_navigation.control.goal_run import GoalRun
from rover_navigation.embedded_goal import EmbeddedGoal
from rover_navigation.hazards import Hazards
from rover_navigation.localization.localizer import Localizer
from rover_navigation.navigator import GoalStatus
from rover_navigation.navigator_config import NavigatorConfig
from rover_navigation.path_planner import Ground
from rover_navigation.scale import Scale
from rover_navigation.types import NO_POINTS


@dataclass(frozen=True)
class NavigatorOutput:
    """What one step says."""

    stamp: int  # [ns] of the batch
    twist: Twist | None  # None while there is no goal: then another controller may drive
    pose: Pose | None  # of base_footprint in the map; None before there is a map
    covariance: NDArray[np.float64]  # (3, 3) of x, y [m], yaw [rad]
    map_to_odom: Pose | None  # the odom frame in the map; None while the pose is not known
    relocations: int  # times so far that the pose was lost and found by search
    map: GridMap | None  # when a new one is due
    path: NDArray[np.float64]  # (n, 2) [m] to the goal, for people
    why: str  # what it does, or why it does not drive


class EmbeddedNavigator:
    """A `Navigator` in the same process: `step` with every batch, at the controller's 20 Hz.

    The same batches and goals with the same seed give the same outputs, bit for bit.
    """

    def __init__(
        self, model: BurgerModel, scale: Scale, config: NavigatorConfig, seed: int
    ) -> None:
        self._model = model
        self._scale = scale
        self._config = config
        self._localizer = Localizer(model, config.resolution)
        self._hazards = Hazards()
        self._run = GoalRun(model, scale, config, np.random.default_rng(seed))
        self._goal: EmbeddedGoal | None = None
        self._relocations = 0  # that the goal's run has taken notice of
        self._last_scan = self._last_odometry = 0  # [ns]
        self._next_map = 0  # [ns]
        self._given: tuple[GridMap, ...] = ()  # the last maps that were given out

    @property
    def is_ready(self) -> bool:
        """Whether there is a map and a pose in it."""
        return self._localizer.is_ready and not self._localizer.is_lost

    @property
    def has_map(self) -> bool:
        """Also while the pose in it is searched."""
        return self._localizer.is_ready

    @property
    def map_begun(self) -> int:
        """[ns] When its map was begun, which tells it from another one; 0 before there is one."""
        return self._localizer.map.begun

    def memory(self) -> Callable[[], Memory]:
        """Map, pose and level as they are now, of one that has a map.

        The copy is made at once; what is called makes a memory of it, in any thread.
        """
        return self._localizer.memory()

    def restore(self, memory: Memory) -> None:
        """Go on with the map and the pose whose `memory` it is; only before there is a map.

        Goals and blocked places are not in it. Raises ValueError, TypeError or KeyError for
        anything else, and changes nothing then.
        """
        localizer = Localizer(self._model, self._config.resolution)
        localizer.restore(memory)
        self._localizer = localizer
        self._relocations = localizer.relocations
        self._given = (localizer.map.cells.grid(),)

    def go_to(self, pose: Pose, tolerance: float) -> EmbeddedGoal:
        """Drive to a pose of the map; a goal that cannot be driven to has failed at once.

        While the pose is searched a goal waits, as one that was given before does.
        """
        goal = EmbeddedGoal(pose, tolerance)
        if self._goal is not None:
            self._goal.end(GoalStatus.CANCELLED, "replaced by another goal")
        self._goal = None
        if reason := self._refusal(goal):
            goal.end(GoalStatus.FAILED, reason)
        else:
            self._goal = goal
            self._run.begin(goal)
        return goal

    def _refusal(self, goal: EmbeddedGoal) -> str:
        """Why a goal cannot be driven to; empty when it can."""
        here = self._localizer.buffer.latest()
        if here is None or not self._localizer.is_ready:
            return "there is no pose in a map"
        if self._localizer.is_lost:
            return ""
        ground = self._ground(here)
        reason = ground.refusal(goal.pose, goal.tolerance)
        if not reason and len(ground.path(here, goal.pose, goal.tolerance)) == 0:
            return "no path to the goal"
        return reason

    def set_hazards(self, hazards: GridMap) -> None:
        """One of the maps that were given out, with blocked places in it, which paths keep off.

        It replaces the one before. What was a wall on one of those maps is not blocked for that.
        """
        if self._hazards.set(hazards, *self._given):
            self._run.replan()

    def pose_at(self, stamp: int) -> Pose | None:
        """Of base_footprint in the map at a stamp [ns]; None where the odometry does not reach."""
        return self._localizer.buffer.pose_at(stamp)

    def step(self, batch: SensorBatch) -> NavigatorOutput:
        """Take what the sensors said, and drive on."""
        self._note_inputs(batch)
        self._localizer.update(batch)
        pose = self._pose_now(batch)
        twist, why = self._drive(pose, batch.stamp)
        return NavigatorOutput(
            batch.stamp,
            twist,
            pose,
            self._localizer.covariance,
            None if self._localizer.is_lost else self._localizer.map_to_odom,
            self._localizer.relocations,
            self._map_when_due(batch.stamp),
            NO_POINTS if twist is None else self._run.path,
            why,
        )

    def _drive(self, pose: Pose | None, stamp: int) -> tuple[Twist | None, str]:
        """The velocity, None where there is no goal, and why it is that."""
        trouble = self._trouble(stamp)
        goal = self._goal
        if goal is None or goal.status.final or pose is None:
            self._goal = None
            return None, trouble or "no goal"
        if trouble:
            self._run.hold()
            return Twist(), trouble
        twist = self._run.step(stamp, pose, self._ground, self._localizer.free_side())
        if goal.status.final:
            self._goal = None
            return None, goal.reason or goal.status.value
        return twist, self._run.why

    def _trouble(self, stamp: int) -> str:
        """Why nothing can be driven now; empty when it can."""
        timeout = self._config.input_timeout
        for name, last in (("scan", self._last_scan), ("odometry", self._last_odometry)):
            if (stamp - last) / 1e9 > timeout:
                return f"no {name} for {timeout:g} s"
        if not self._localizer.is_ready:
            return "standing still for the first map"
        if self._localizer.is_lost:
            return "searching the pose"
        before, self._relocations = self._relocations, self._localizer.relocations
        return "found the pose again" if self._relocations > before else ""

    def _note_inputs(self, batch: SensorBatch) -> None:
        if batch.scans:
            self._last_scan = batch.stamp
        if batch.odometry:
            self._last_odometry = batch.stamp

    def _pose_now(self, batch: SensorBatch) -> Pose | None:
        """The newest pose, carried on to the batch's stamp."""
        pose, newest = self._localizer.buffer.latest(), self._localizer.newest_odometry
        if pose is None or newest is None:
            return None
        seconds = min(max(0.0, (batch.stamp - newest.stamp) / 1e9), 0.1)
        moved = Pose(newest.twist.linear * seconds, 0.0, newest.twist.angular * seconds)
        return compose(pose, moved)

    def _ground(self, body: Pose) -> Ground:
        return Ground(self._localizer.map.cells.grid(), self._hazards, body, self._scale)

    def _map_when_due(self, stamp: int) -> GridMap | None:
        if not self._localizer.is_ready or stamp < self._next_map:
            return None
        self._next_map = stamp + round(self._config.map_period * 1e9)
        grid = self._localizer.map.cells.grid()
        self._given = (*self._given[-1:], grid)
        return grid
