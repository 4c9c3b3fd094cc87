"""The decision core: a frame in, a decision out. It owns the run; node, loop and tests use it.

    step(frame): a new run? -> the plan in force -> the mission's tick -> the order of a plan

A run begins when the frames' run number changes, and everything starts anew with it: the mission,
its plans and the maps that wait for them. A request to reset asks the bridge for a new run, and
brakes until it has begun.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from typing import Any, Generic, Protocol, TypeVar

from rover_common.types import GridMap, Run
from rover_decision.types import Request
from rover_navigation.plan_scheduler import MakePlan, MakeRequest, PlanScheduler, PlanStatus


class CoreFrame(Protocol):
    """What the core itself reads of a frame."""

    @property
    def stamp(self) -> int:
        """[ns]"""

    @property
    def run(self) -> Run: ...

    @property
    def needs_plan(self) -> bool:
        """Whether a plan is to be made of what is known at it."""


FrameT = TypeVar("FrameT", bound=CoreFrame)
DecisionT = TypeVar("DecisionT")
PlanT = TypeVar("PlanT")
OverlayT = TypeVar("OverlayT")
FrameT_contra = TypeVar("FrameT_contra", bound=CoreFrame, contravariant=True)
DecisionT_co = TypeVar("DecisionT_co", covariant=True)
OverlayT_co = TypeVar("OverlayT_co", covariant=True)


class Mission(Protocol[FrameT_contra, DecisionT_co, PlanT, OverlayT_co]):
    """What a mission offers to the core; an instance serves one run."""

    @property
    def state(self) -> IntEnum: ...

    @property
    def over(self) -> bool:
        """Nothing is left to do."""

    @property
    def idle(self) -> bool:
        """It has not begun."""

    @property
    def failed(self) -> bool:
        """It cannot go on by itself."""

    def configure(self, config: Any) -> None:
        """Go on with other parameters from the next tick on."""

    def tick(self, frame: FrameT_contra, plans: PlanStatus[PlanT]) -> DecisionT_co:
        """Decide about one frame."""

    def wait_for_run(self) -> DecisionT_co:
        """What to do until a new run begins: ask for it, and stand."""

    def plan_request(self, frame: FrameT_contra) -> MakeRequest[Any]:
        """What a plan is to be made of, asked right after the frame's tick."""

    def request(self, request: Request) -> bool:
        """Whether the mission can do what it is asked for."""

    def limit_time(self, seconds: float) -> None:
        """Be over within so many seconds from the first frame on."""

    def overlay(self) -> OverlayT_co:
        """What it knows about places."""


class DecisionCore(Generic[FrameT, DecisionT, PlanT, OverlayT]):
    """One robot's decisions, run after run."""

    def __init__(
        self,
        make_mission: Callable[[], Mission[FrameT, DecisionT, PlanT, OverlayT]],
        make_plan: MakePlan[Any, PlanT],
        plan_delay: float,
        lockstep: bool,
    ) -> None:
        """plan_delay: [s] of frame time until a plan counts; lockstep: frames wait for it."""
        self._make_mission = make_mission
        self._plans = PlanScheduler(make_plan, plan_delay, lockstep)
        self._mission = make_mission()
        self._run: Run | None = None
        self._leaving = False  # the run at hand is to end
        self.mission_number = 1  # counts the missions, so that one can be told from the next

    @property
    def last_failure(self) -> str:
        """Why the newest of them did not come."""
        return self._plans.last_failure

    @property
    def plan_failures(self) -> int:
        """Plans that were asked for and did not come, in all runs."""
        return self._plans.failures

    @property
    def state(self) -> IntEnum:
        return self._mission.state

    @property
    def mission(self) -> Mission[FrameT, DecisionT, PlanT, OverlayT]:
        """The one of the run at hand."""
        return self._mission

    @property
    def run(self) -> Run | None:
        """The one at hand; None before the first frame."""
        return self._run

    def resume(self, run: Run, mission: Mission[FrameT, DecisionT, PlanT, OverlayT]) -> None:
        """Go on with a mission that was begun in this run, and has no plan yet."""
        self._run, self._mission = run, mission
        self._plans.begin(run.start)

    def step(self, frame: FrameT) -> DecisionT:
        """Decide about one frame."""
        self._follow_run(frame.run)
        if self._leaving:
            return self._mission.wait_for_run()
        decision = self._mission.tick(frame, self._plans.status_at(frame.stamp))
        if frame.needs_plan:
            self._plans.order(frame.stamp, self._mission.plan_request(frame))
        return decision

    def give_map(self, stamp: int, grid: GridMap) -> None:
        """The navigation map of a frame [ns] has come, before or after the frame itself."""
        if self._run is None or self._run.holds(stamp):
            self._plans.give_map(stamp, grid)

    def ready(self, stamp: int) -> bool:
        """Whether a frame of this stamp [ns] can be decided on now; only lockstep waits."""
        return self._plans.ready(stamp)

    def stop_waiting(self) -> None:
        """The maps that frames wait for will not come: their plans have failed."""
        self._plans.drop_waiting()

    def request(self, request: Request) -> bool:
        """Whether the mission does what it is asked for."""
        if request is Request.RESET or (request is Request.START and self._mission.over):
            self._begin()
            self._leaving = self._run is not None
            return True
        return self._mission.request(request)

    def configure(
        self,
        config: Any,
        make_mission: Callable[[], Mission[FrameT, DecisionT, PlanT, OverlayT]],
        make_plan: MakePlan[Any, PlanT],
    ) -> None:
        """Other parameters: for the mission at hand, for those to come, and for the plans."""
        self._make_mission = make_mission
        self._plans.use(make_plan)
        self._mission.configure(config)

    def limit_time(self, seconds: float) -> None:
        """Let this mission be over within so many seconds from its first frame on."""
        self._mission.limit_time(seconds)

    def close(self) -> None:
        """End the planner's thread."""
        self._plans.close()

    def _follow_run(self, run: Run) -> None:
        """Begin anew when the frames belong to another run."""
        before, self._run = self._run, run
        if before is None or before.number == run.number:
            return
        if not self._leaving:
            self._begin()
        self._leaving = False
        self._plans.begin(run.start)

    def _begin(self) -> None:
        """A new mission, which its first frame starts."""
        self._mission = self._make_mission()
        self.mission_number += 1
