"""The mission: what happened, what state follows from it, and what to do; one tick per frame.

inputs, tilt, sensing -> the state's event -> the chart -> the state's action -> who drives
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

from rover_common.geometry import Pose
from rover_common.saved_state import Memory, joined, part_of
from rover_decision.types import Request
from rover_heat.config import HeatConfig
from rover_heat.mission import memory
from rover_heat.mission.chart import Event, Machine, State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.states import RECOVERING, make_states
from rover_heat.mission.tick import HeatAction, HeatTick
from rover_heat.planning.types import HeatPlan, HeatPlanRequest
from rover_heat.types import HeatDecision, HeatFrame, HeatOverlay, HeatProgress
from rover_navigation.navigator import Navigator
from rover_navigation.plan_scheduler import MakeRequest, PlanStatus

UNKNOWN = Pose(0.0, 0.0, 0.0)  # before there is a pose


class HeatMission:
    """Find what is warm, deliver to each, climb the ramp: one run of it."""

    def __init__(self, config: HeatConfig, navigator: Navigator) -> None:
        self._config = config
        self._machine = Machine()
        self._entered_state = self._machine.state
        self._entered: float | None = None  # [s] when
        self._parts = HeatParts.of(config, navigator)
        self._states = make_states(self._parts)
        self._plan: HeatPlan | None = None
        self._explored = 0.0  # of the last plan that knows
        self._failure = ""  # why it has failed

    @property
    def state(self) -> State:
        return self._machine.state

    @property
    def over(self) -> bool:
        return self.state is State.DONE

    @property
    def idle(self) -> bool:
        return self._parts.begun is None

    @property
    def failed(self) -> bool:
        return self.state is State.FAILED

    @property
    def parts(self) -> HeatParts:
        """For tests and reports; not to be written to."""
        return self._parts

    def request(self, request: Request) -> bool:
        """Whether the mission can do what it is asked for."""
        if request is Request.PAUSE:
            return self._machine.handle(Event.pause)
        if request is Request.RESUME:
            return self._machine.handle(Event.resume)
        if request is Request.RETURN_HOME:  # recalled: it ends where it stands
            return self._machine.handle(Event.finish)
        return request is Request.START and self.idle

    def limit_time(self, seconds: float) -> None:
        """Be done within so many seconds from the first frame on; 0 for the parameter's."""
        self._parts.time_limit = seconds or self._config.time_limit

    def configure(self, config: HeatConfig) -> None:
        """No parameter of this mission may be set while it runs."""

    def wait_for_run(self) -> HeatDecision:
        """Ask for a new run, and stand until it has begun."""
        return HeatDecision(self.state, "waits for a new run", HeatAction("").twist, new_run=True)

    def tick(self, frame: HeatFrame, plans: PlanStatus[HeatPlan]) -> HeatDecision:
        """Decide about one frame."""
        tick = self._observe(frame, plans)
        event = self._states[self.state].event(tick)
        if event is Event.gave_up:
            self._failure = self._states[self.state].act(tick).reason
        if event is not None and self._machine.handle(event):
            tick = self._enter(tick)
        action = self._states[self.state].act(tick)
        parts = self._parts
        twist = parts.owner.command(tick.time, action.twist)
        parts.trip.update(tick.time, parts.owner.navigator_drives(tick.time))
        notices, parts.notices = tuple(parts.notices), []
        reason = self._failure if self.state is State.FAILED else action.reason
        return HeatDecision(
            state=self.state,
            reason=reason,
            twist=twist,
            launch=action.launch,
            hazards=parts.ramps.hazards,
            progress=self._progress(tick),
            notices=notices,
        )

    def plan_request(self, frame: HeatFrame) -> MakeRequest[HeatPlanRequest]:
        """What a plan is to be made of, as things stand at this frame."""
        parts = self._parts
        return partial(
            HeatPlanRequest,
            frame.stamp,
            pose=frame.pose or UNKNOWN,
            fixes=tuple(parts.sensing.fixes),
            examined=parts.sensing.coverage.snapshot(),
            hazards=parts.ramps.hazards,
            ramps=parts.ramps.ramps,
            trail=parts.trail.points,
            known=parts.goals.known(),
            failed=parts.goals.not_now(frame.time),
            sensors=parts.sensing.alive,
            start=parts.start,
            goal=parts.trip.goal,
            seek_ramp=self.state is State.ATTEMPTING_RAMP,
        )

    def memory(self) -> Memory:
        """What a mission needs to know that goes on with this one."""
        limit = self._parts.time_limit
        values = {
            "phase": [event.name for event in self._machine.phase],
            "time_limit": None if limit == self._config.time_limit else limit,
            "interrupts": self._interrupts,
            "failure": self._failure,
            "explored": self._explored,
        }
        return joined(mission=(values, {}), parts=memory.memory_of(self._parts))

    def restore(self, known: Memory, places: bool = True) -> None:
        """Go on with the mission whose `memory` it is, in its phase; only before the first frame.

        places: also what it knew of its map. Raises ValueError, TypeError or KeyError for anything
        else, and is not to be used then.
        """
        values, _ = part_of(known, "mission")
        memory.restore(self._parts, part_of(known, "parts"), places)
        self.limit_time(float(values["time_limit"] or 0.0))
        self._states[State.TILT_INTERRUPT].recoveries = int(values["interrupts"])
        self._failure = str(values["failure"])
        self._explored = float(values["explored"]) if places else 0.0
        self._machine.enter([Event[name] for name in values["phase"]])

    def overlay(self) -> HeatOverlay:
        """What it knows about places."""
        parts, plan = self._parts, self._plan
        overlay = HeatOverlay(
            sources=parts.sources.sources,
            hazards=parts.ramps.hazards,
            visited=parts.goals.visited,
            trail=parts.trail.points,
            goal=parts.trip.goal,
        )
        if plan is None:
            return overlay
        return replace(
            overlay, frontiers=plan.frontiers, faces=plan.faces, open_faces=plan.open_faces
        )

    def _observe(self, frame: HeatFrame, plans: PlanStatus[HeatPlan]) -> HeatTick:
        """Bring all that is remembered up to date."""
        parts = self._parts
        health = parts.update(frame, plans)
        new = parts.take_plan(plans.plan)
        self._plan = plans.plan
        if self._entered is None:
            self._entered = frame.time
        pose, since = frame.pose or UNKNOWN, frame.time - self._entered
        tick = HeatTick(frame, pose, plans.plan, new, health, since)
        if self.state is not self._entered_state:  # a request came in between
            return self._enter(tick)
        self._states[self.state].update(tick)
        return tick

    def _enter(self, tick: HeatTick) -> HeatTick:
        """A new state begins at this frame."""
        before, self._entered_state = self._entered_state, self.state
        parts = self._parts
        self._entered = tick.time
        parts.slip.restart()
        parts.notices.append(f"{before.name} -> {self.state.name}")
        tick = replace(tick, since=0.0)
        self._states[self.state].enter(tick, before)
        return replace(tick, health=replace(tick.health, stopped_moving=False))

    @property
    def _interrupts(self) -> int:
        return sum(self._states[state].recoveries for state in RECOVERING)

    def _progress(self, tick: HeatTick) -> HeatProgress:
        parts = self._parts
        begun = tick.time if parts.begun is None else parts.begun
        if self._plan is not None and math.isfinite(self._plan.explored):
            self._explored = self._plan.explored
        return HeatProgress(
            elapsed=tick.time - begun,
            explored=self._explored,
            sources_known=len(parts.sources.sources),
            sources_delivered=parts.sources.delivered,
            payloads=parts.agenda.payloads,
            interrupts=self._interrupts,
            ramp_known=bool(parts.ramps.ramps),
            ramp_done=parts.ramps.done,
            distance=parts.inputs.distance,
        )
