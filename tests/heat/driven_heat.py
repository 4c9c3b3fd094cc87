"""A heat mission that is driven tick by tick, with frames, plans and a navigator by hand."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from imus import imu
from warm_room import Room, box

from rover_common.geometry import Pose, distance_between
from rover_common.sensor_types import ThermalFrame, Twist
from rover_common.types import GridMap
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_heat.mission.mission import HeatMission
from rover_heat.planning.types import GoalKind, HeatGoal, HeatPlan, StandOff
from rover_heat.ramp.estimate import Ramp
from rover_heat.thermal.sources import Group
from rover_heat.types import HeatDecision, HeatFrame
from rover_navigation.navigator import GoalStatus
from rover_navigation.plan_scheduler import PlanStatus

STEP = 0.05  # [s] of a tick
SECOND = 1_000_000_000
ROOM = Room(box(4.0, 4.0))
MIDDLE = Pose(2.0, 2.0, 0.0)
GRID = GridMap(0.05, 0.0, 0.0, np.zeros((80, 80), np.int8))
AIR = np.full((8, 8), 24.0, np.float32)
RAMP_PITCH = -0.119  # [rad]
GOAL = HeatGoal(GoalKind.FRONTIER, Pose(3.0, 2.0, 0.0), 3.4, 2.0, 5.0)
SOURCE = Group(2.0, 4.0, (4e-4, 0.0, 0.0, 4e-4), -math.pi / 2, 3000, 0.5, 8.0)
STAND = StandOff(Pose(2.0, 3.7, math.pi / 2), 8.0)
RAMP = Ramp(3.0, 1.0, 0.0)
APPROACH = StandOff(RAMP.before_foot(0.5), 6.0)


def goal_plan(*goals: HeatGoal, **what: Any) -> HeatPlan:
    """Some frontiers are left, and the robot is on its way to one of them."""
    frontiers = np.array([(goal.x, goal.y) for goal in goals], float).reshape(-1, 2)
    return HeatPlan(0, **({"goals": goals, "frontiers": frontiers, "goal_seconds": 5.0} | what))


@dataclass
class FakeGoal:
    """A handle that the test writes."""

    pose: Pose
    tolerance: float
    status: GoalStatus = GoalStatus.DRIVING
    distance_left: float = 2.0
    recovering: bool = False
    reason: str = ""

    def cancel(self) -> None:
        if not self.status.final:
            self.status = GoalStatus.CANCELLED


@dataclass
class FakeNavigator:
    is_ready: bool = True
    refuses: str = ""
    goals: list[FakeGoal] = field(default_factory=list)

    def go_to(self, pose: Pose, tolerance: float) -> FakeGoal:
        if self.goals:
            self.goals[-1].cancel()
        status = GoalStatus.FAILED if self.refuses else GoalStatus.DRIVING
        self.goals.append(FakeGoal(pose, tolerance, status, reason=self.refuses))
        return self.goals[-1]


@dataclass
class StandingPoses:
    """Where the robot is, at whatever stamp."""

    pose: Pose

    def pose_at(self, stamp: int) -> Pose | None:
        return self.pose


class DrivenHeat:
    """Every tick has all inputs unless it is told otherwise."""

    def __init__(self, config: HeatConfig | None = None, room: Room = ROOM) -> None:
        self.config = config or HeatConfig()
        self.navigator = FakeNavigator()
        self.mission = HeatMission(self.config, self.navigator)
        self.room = room
        self.pose = MIDDLE
        self.time = 10.0  # [s] of the next tick
        self.plan = goal_plan(GOAL)
        self.notices: list[str] = []
        self.launches = 0
        self.plans = True  # whether new ones come
        self._planned = -math.inf
        self._count = 0

    @property
    def state(self) -> State:
        return self.mission.state

    @property
    def goal(self) -> FakeGoal:
        """The newest that the navigator was given."""
        return self.navigator.goals[-1]

    def frame(self, **what: Any) -> HeatFrame:
        """At the time of the next tick. what: pose, twist, pitch, roll, turn, air, and fields of
        the frame, which come as they are."""
        stamp = round(self.time * SECOND)
        pose = what.pop("pose", self.pose)
        seen = pose or self.pose
        turn, level = what.pop("turn", 0.0), (what.pop("roll", 0.0), what.pop("pitch", 0.0))
        air = what.pop("air", AIR)
        fast = self._count % 2 == 0
        imus = tuple(imu(stamp - step * 10_000_000, *level, rates=(0.0, 0.0, turn))
                     for step in (4, 3, 2, 1, 0))  # fmt: skip
        parts: dict[str, Any] = {
            "poses": StandingPoses(seen),
            "pose": pose,
            "pose_stamp": stamp,
            "grid": GRID,
            "imus": imus,
            "scans": (self.room.scan(seen, stamp),) if fast else (),
            "thermal": tuple(ThermalFrame(stamp, n, air) for n in (1, 2)) if fast else (),
            "twist": Twist(0.0, turn),
        }
        return HeatFrame(stamp, **(parts | what))

    def tick(self, **what: Any) -> HeatDecision:
        """One tick. what: as for `frame`, and `plan` None for none, `failure`, `plan_age` [s]."""
        failure = what.pop("failure", None)
        age = what.pop("plan_age", None)
        plan = what.pop("plan", self.plan)
        if self.plans and self.time - self._planned >= 1.0 and age is None:
            self._planned = self.time
        stamp = round((self._planned if age is None else self.time - age) * SECOND)
        status = PlanStatus(None if plan is None else replace(plan, stamp=stamp), failure)
        decision = self.mission.tick(self.frame(**what), status)
        self.time += STEP
        self._count += 1
        self.notices += decision.notices
        self.launches += decision.launch
        return decision

    def ticks(self, seconds: float, **what: Any) -> list[HeatDecision]:
        return [self.tick(**what) for _ in range(round(seconds / STEP))]

    def until(
        self, reached: Callable[[HeatDecision], bool], seconds: float, **what: Any
    ) -> HeatDecision:
        """The first decision for which it holds; fails after so many seconds."""
        end = self.time + seconds
        decision = None
        while self.time < end:
            decision = self.tick(**what)
            if reached(decision):
                return decision
        raise AssertionError(f"not within {seconds} s: {decision}")

    def until_goal(self, pose: Pose, seconds: float = 3.0, **what: Any) -> HeatDecision:
        """The first decision after which the navigator drives to a pose."""
        return self.until(lambda _: bool(self.navigator.goals) and self.goal.pose == pose
                          and not self.goal.status.final, seconds, **what)  # fmt: skip

    def until_state(self, state: State, seconds: float, **what: Any) -> HeatDecision:
        return self.until(lambda made: made.state is state, seconds, **what)

    def move_to(self, pose: Pose, **what: Any) -> None:
        """The robot goes there, not so fast that its pose jumps."""
        start = self.pose
        steps = 2 * math.ceil(distance_between(start, pose) / 0.2) + 1
        for share in np.linspace(0.0, 1.0, steps)[1:].tolist():
            x, y = start.x + share * (pose.x - start.x), start.y + share * (pose.y - start.y)
            self.pose = Pose(x, y, pose.yaw)
            self.tick(**what)
        self.pose = pose

    def arrive(self) -> None:
        """The navigator reaches its goal."""
        goal = self.goal
        self.move_to(goal.pose)
        goal.status = GoalStatus.REACHED
