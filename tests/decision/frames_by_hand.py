"""Frames by hand for the mission, and a mission that is driven by them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from maps import MIDDLE, straight_plan
from scans import BEARINGS, RANGE, open_scan

from rover_common.geometry import Pose, bearing_to
from rover_common.types import FIRST_RUN, FreeScan, PolarArray, RockTrack, Run, VehicleState
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.mission import SampleReturnMission
from rover_decision.types import Decision, Frame, Request
from rover_navigation.plan_scheduler import PlanStatus
from rover_navigation.types import Plan, PlanFailed

CONFIG = DecisionConfig()
PLAN = straight_plan()
STEP = 0.1  # [s] between two frames
AWAY = Pose(MIDDLE.x + 2.5, MIDDLE.y, 0.0)  # a step of the rover, but not home any more
TILTED = Pose(MIDDLE.x, MIDDLE.y, 0.0, pitch=-0.3)


def nanoseconds(seconds: float) -> int:
    return round(seconds * 1e9)


def rock(x: float, y: float, number: int = 1) -> RockTrack:
    return RockTrack(number, x, y, (0.01, 0.0, 0.0, 0.01), 10, 0)


def frame(
    time: float,
    pose: Pose = MIDDLE,
    ahead: float = RANGE,
    map_age: float = 0.0,
    run: Run = FIRST_RUN,
    rocks: tuple[RockTrack, ...] = (),
    **vehicle: Any,
) -> Frame:
    """Open ground for `ahead` [m] in every direction; maps of `map_age` [s] before the time [s]."""
    fields: dict[str, Any] = {
        "speed": 0.0, "near_sample": False, "picking_up": False, "sample_count": 3
    }  # fmt: skip
    state = VehicleState(nanoseconds(time), pose, run=run, **(fields | vehicle))
    return frame_of(state, open_scan(ahead), rocks, nanoseconds(time - map_age))


def frame_of(
    vehicle: VehicleState, scan: FreeScan, rocks: tuple[RockTrack, ...], map_stamp: int
) -> Frame:
    """Each bearing holds a ground cell in every quarter of a metre of its free length."""
    lengths = (4 * np.minimum(scan.ranges, RANGE)).astype(int)
    bearings = np.repeat(BEARINGS, lengths).astype(np.float32)
    counts = np.arange(len(bearings)) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    nav = PolarArray(((counts + 1) / 4).astype(np.float32), bearings)
    return Frame(vehicle, nav, scan, rocks, map_stamp, _rock_cells(vehicle.pose, rocks))


def _rock_cells(pose: Pose, rocks: tuple[RockTrack, ...]) -> PolarArray:
    """One cell for each rock in view."""
    ranges = [math.hypot(each.x - pose.x, each.y - pose.y) for each in rocks]
    bearings = [bearing_to(pose, each.x, each.y) for each in rocks]
    seen = np.abs(np.array(bearings, float)) < BEARINGS.max()
    return PolarArray(np.array(ranges, np.float32)[seen], np.array(bearings, np.float32)[seen])


class DrivenMission:
    """A mission with frames by hand, and plans that are given to it."""

    def __init__(self, config: DecisionConfig = CONFIG, time: float = 1.0) -> None:
        self.mission = SampleReturnMission(config)
        self.time = time  # [s] of the next frame

    @property
    def state(self) -> State:
        return self.mission.state

    def tick(
        self,
        after: float = STEP,
        plan: Plan | None = PLAN,
        plan_age: float = 0.0,
        failure: PlanFailed | None = None,
        **what: Any,
    ) -> Decision:
        """Decide about a frame, with a plan of `plan_age` [s]; the next is `after` [s] later.

        `what`: as for `frame`.
        """
        if plan is not None:
            plan = replace(plan, stamp=nanoseconds(self.time - plan_age))
        decision = self.mission.tick(frame(self.time, **what), PlanStatus(plan, failure))
        self.time += after
        return decision

    def ticks(self, seconds: float, **what: Any) -> list[Decision]:
        """Decide about frames like this one for so many seconds."""
        return [self.tick(**what) for _ in range(round(seconds / STEP))]

    def tick_until(
        self, reached: Callable[[Decision], bool] | State, seconds: float, **what: Any
    ) -> Decision:
        """The first decision that it was reached with; fails after so many seconds."""
        end = self.time + seconds
        while self.time < end:
            decision = self.tick(**what)
            if decision.state is reached if isinstance(reached, State) else reached(decision):
                return decision
        raise AssertionError(f"not within {seconds} s: {decision}")

    def wait(self, seconds: float) -> None:
        """The next frame is this much later than it would be."""
        self.time += seconds

    def request(self, request: Request) -> bool:
        return self.mission.request(request)


def exploring(config: DecisionConfig = CONFIG, **what: Any) -> DrivenMission:
    """A mission that explores since the time 1.0 s."""
    mission = DrivenMission(config)
    mission.tick(**what)
    assert mission.state is State.FORWARD
    return mission


def heading_home() -> DrivenMission:
    """A mission that is on its way home, 2.5 m away."""
    mission = exploring()
    mission.request(Request.RETURN_HOME)
    mission.tick(pose=AWAY)
    assert mission.state is State.RETURN_HOME
    return mission


def over() -> DrivenMission:
    mission = exploring()
    mission.request(Request.RETURN_HOME)
    mission.tick()
    assert mission.state is State.DONE
    return mission
