"""A decision core with frames, maps and plans by hand."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from frames_by_hand import CONFIG, PLAN, STEP, frame, nanoseconds
from maps import MIDDLE, UNKNOWN

from rover_common.geometry import Pose
from rover_common.types import FIRST_RUN, Run
from rover_decision.core import DecisionCore
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.mission import SampleReturnMission
from rover_decision.types import Decision
from rover_navigation.types import Plan, PlanRequest

DELAY = CONFIG.plan_delay
PATIENCE = 5.0  # [s] until a test counts as failed


class HandPlanner:
    """Makes the plan that it is told to, when it is told to."""

    def __init__(self, plan: Plan = PLAN) -> None:
        self.plan = plan
        self.fails = False
        self.gate = threading.Event()  # closed, it hangs
        self.gate.set()
        self.hangs = math.inf  # so often, while it is closed
        self.requests: list[PlanRequest] = []

    def __call__(self, request: PlanRequest) -> Plan:
        self.requests.append(request)
        if self.hangs > 0 and not self.gate.is_set():
            self.hangs -= 1
            self.gate.wait()
        if self.fails:
            raise ZeroDivisionError("no such thing")
        return replace(self.plan, stamp=request.stamp)


def to_and_fro(place: Pose, time: float) -> Pose:
    """At a time [s], of a rover that moves by 0.3 m around a place, so that it is not stuck."""
    return replace(place, x=place.x + 0.3 * math.sin(math.pi * (time - 1.0)))


class CoreBench:
    """Steps a core frame by frame; each frame's map follows it at once."""

    def __init__(self, lockstep: bool = True, config: DecisionConfig = CONFIG) -> None:
        self.planner = HandPlanner()
        make_mission = partial(SampleReturnMission, config)
        self.core = DecisionCore(make_mission, self.planner, config.plan_delay, lockstep)
        self.lockstep = lockstep
        self.time = 1.0  # [s] of the next frame
        self.run = FIRST_RUN
        self.place = MIDDLE  # that the rover moves to and fro around
        self.maps = True  # whether they come

    def step(self, after: float = STEP, **what: Any) -> Decision:
        """Decide about a frame; the next one is `after` [s] later. `what`: as for `frame`."""
        what = {"pose": to_and_fro(self.place, self.time)} | what
        shown = frame(self.time, run=self.run, **what)
        decision = self.core.step(shown)
        if self.maps and shown.map_stamp == shown.stamp:
            self.core.give_map(shown.stamp, UNKNOWN)
            self.settle()
        self.time += after
        return decision

    def settle(self) -> None:
        """Wait until all plans are made that can be; in lockstep the core waits by itself."""
        if not self.lockstep and self.planner.gate.is_set():
            self.core._plans._pool.submit(int).result(PATIENCE)

    def steps(self, seconds: float, **what: Any) -> list[Decision]:
        return [self.step(**what) for _ in range(round(seconds / STEP))]

    def step_until(
        self, reached: Callable[[Decision], bool], seconds: float, **what: Any
    ) -> Decision:
        """The first decision for which it holds; fails after so many seconds."""
        end = self.time + seconds
        while self.time < end:
            decision = self.step(**what)
            if reached(decision):
                return decision
        raise AssertionError(f"not within {seconds} s: {decision}")

    def begin_run(self) -> Run:
        """The bridge begins a new run with the next frame."""
        self.run = Run(self.run.number + 1, nanoseconds(self.time))
        return self.run

    def close(self) -> None:
        self.planner.gate.set()
        self.core.close()
