"""The mission: what happened, what state follows from it, and what to do; one tick per frame.

monitors -> the state's event -> the chart -> the state's action
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from rover_common.saved_state import Memory
from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import Event, Machine, State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.solution import Solution
from rover_decision.missions.sample_return.solutions import kind_of, make_solution
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Decision, Frame, Overlay, Request
from rover_navigation.monitors import CIRCLE_SPEED
from rover_navigation.plan_scheduler import MakeRequest, PlanStatus
from rover_navigation.types import NO_POINTS, Plan, PlanRequest

# Between these it may go to and fro for ever: only to leave the spot is progress then.
TO_AND_FRO = {State.FORWARD, State.STOP, State.CIRCLE}
EXPLORING = TO_AND_FRO | {State.ROCK_APPROACH}
HOMEWARD = {State.RETURN_HOME, State.DONE}


class SampleReturnMission:
    """Explore, collect the samples, come home: one run of it."""

    def __init__(self, config: DecisionConfig) -> None:
        self._config = config
        self._new_config: DecisionConfig | None = None  # for the next tick
        self._time_limit = config.time_limit
        self._recoveries_before = 0
        self._return_requested = False  # to be done when what goes on has come to its end
        self._parts = Parts.of(config)
        self._drivers = Drivers(self._parts.actuation, self._parts.scale, config)
        self._run_solution(make_solution(config, self._parts, self._drivers))
        self._tick: TickContext | None = None  # the newest

    @property
    def state(self) -> State:
        return self._machine.state

    @property
    def over(self) -> bool:
        return self.state is State.DONE

    @property
    def idle(self) -> bool:
        return self.state is State.IDLE

    @property
    def failed(self) -> bool:
        """Never: without plans it comes home by sight."""
        return False

    def request(self, request: Request) -> bool:
        """Whether the mission can do what it is asked for."""
        if request is Request.PAUSE:
            return self._machine.handle(Event.pause)
        if request is Request.RESUME:
            return self._machine.handle(Event.resume)
        if request is Request.START and self.idle:
            self._return_requested = False
            return True
        if request is Request.RETURN_HOME and not self.over:
            self._return_requested = True
            self._machine.handle(Event.finished)
            return True
        return False

    def limit_time(self, seconds: float) -> None:
        """Be home within so many seconds from the first frame on; 0 for the parameter's."""
        self._time_limit = seconds or self._config.time_limit

    def configure(self, config: DecisionConfig) -> None:
        """From the next tick on; of the parameters, those count that may be set in a mission."""
        self._new_config = config

    def tick(self, frame: Frame, plans: PlanStatus[Plan]) -> Decision:
        """Decide about one frame."""
        parts = self._parts
        self._apply_config(frame.time)
        tick = self._observe(frame, plans)
        self._solution.observe(tick, self.state)
        event = self._behavior.event(tick)
        if event is not None and self._machine.handle(event):
            tick = self._enter(tick)
        command, reason = self._behavior.act(tick)
        self._solution.commanded(tick, command)
        driving = self.state is State.FORWARD and abs(tick.speed) > CIRCLE_SPEED
        parts.circle.commanded(tick.time, command.steering_angle, driving)
        parts.motion.commanded(tick.time, tick.pose, command)
        self._tick = tick
        return Decision(command, self.state, reason, parts.progress(frame, self._recoveries))

    def wait_for_run(self) -> Decision:
        """Ask the bridge for a new run, and brake until it has begun."""
        command = replace(SAFE_COMMAND, new_run=True)
        return Decision(command, self.state, "waits for a new run")

    def plan_request(self, frame: Frame) -> MakeRequest[PlanRequest]:
        """What a plan is to be made of, as things stand at this frame; the map comes later."""
        parts, time = self._parts, frame.time
        by_breadcrumbs = parts.home_paths.method.by_breadcrumbs and self._solution.breadcrumb_path
        return partial(
            PlanRequest,
            stamp=frame.stamp,
            pose=frame.pose,
            home=parts.home,
            trail=parts.breadcrumbs.points,
            targets=parts.samples.targets(frame, parts.scale.target_reach),
            blocked=parts.blocked.places,
            blacklisted=parts.goals.blacklisted(time),
            retryable=parts.goals.retryable(time),
            coverage=parts.coverage.snapshot(),
            search=parts.completion.searches,
            last_goal=parts.goals.last,
            home_by_breadcrumbs=self._heads_home and by_breadcrumbs,
        )

    def memory(self) -> Memory:
        """What a mission needs to know that goes on with this one."""
        values, arrays = self._parts.memory()
        config_limit = self._config.time_limit
        values["mission"] = {
            "phase": [event.name for event in self._machine.phase],
            "time_limit": None if self._time_limit == config_limit else self._time_limit,
            "recoveries": self._recoveries,
            "return_requested": self._return_requested,
        }
        return values, arrays

    def restore(self, memory: Memory) -> None:
        """Go on with the mission whose `memory` it is, in its phase; only before the first frame.

        Raises ValueError, TypeError or KeyError for anything else, and is not to be used then.
        """
        mission = memory[0]["mission"]
        self._parts.restore(memory)
        self.limit_time(float(mission["time_limit"] or 0.0))
        self._recoveries_before = int(mission["recoveries"])
        self._return_requested = bool(mission["return_requested"])
        self._run_solution(make_solution(self._config, self._parts, self._drivers))
        self._machine.enter([Event[name] for name in mission["phase"]])

    def overlay(self) -> Overlay:
        """What it knows about places."""
        parts, tick = self._parts, self._tick
        if tick is None:
            return Overlay(NO_POINTS)
        path = None if tick.plan is None else tick.plan.path
        if self._machine.heading_home:
            path = parts.home_paths.method.path(tick.plan, tick.pose)
        return Overlay(parts.breadcrumbs.points, parts.blocked.places, tick.plan, path)

    def _run_solution(self, solution: Solution) -> None:
        """From its beginning: the next frame starts it."""
        self._solution = solution
        self._machine = Machine(solution.chart)
        self._entered_state = self._machine.state
        self._entered = 0.0  # [s] when

    @property
    def _behavior(self) -> StateBehavior:
        return self._solution.states[self.state]

    def _apply_config(self, time: float) -> None:
        """Replace what drives the rover; what is remembered stays."""
        new = self._new_config
        if new is None or self.state is State.PICKUP:  # the arm is waited for by who asked it
            return
        self._new_config = None
        self._drivers.configure(new)
        if kind_of(new) != kind_of(self._config) and not self.over:
            self._change_solution(new)
        if new.way_home != self._config.way_home:
            self._parts.home_paths.prefer(new.way_home, time)
        self._config = new

    def _change_solution(self, config: DecisionConfig) -> None:
        """Go on with another one, in the phase at hand, and paused if that it is."""
        before = self._machine.phase
        self._recoveries_before = self._recoveries
        self._run_solution(make_solution(config, self._parts, self._drivers))
        self._machine.enter(before)

    @property
    def _recoveries(self) -> int:
        """Those of this solution, and of those that ran before."""
        states = self._solution.states.values()
        return self._recoveries_before + sum(state.recoveries for state in states)

    @property
    def _heads_home(self) -> bool:
        return self._machine.heading_home or self._return_requested

    def _observe(self, frame: Frame, plans: PlanStatus[Plan]) -> TickContext:
        """Bring all that is remembered up to date."""
        parts = self._parts
        homeward = self.state in HOMEWARD
        health, plan = parts.update(frame, plans, homeward)
        if self.state in self._solution.approaching:
            parts.samples.spend(frame, health.gap)
        tick = TickContext(
            frame=frame,
            plan=plan,
            local=parts.local_clearance(frame),
            health=health,
            rock=parts.samples.nearest(frame),
            time_left=self._time_limit - parts.elapsed,
            since=frame.time - self._entered,
            explored=parts.explored,
            heading_home=self._machine.heading_home,
            return_requested=self._return_requested,
        )
        exploring = self.state in EXPLORING and not self._return_requested
        parts.completion.update(tick, exploring)
        if self.state is not self._entered_state:  # a request came in between
            return self._enter(tick)
        self._behavior.update(tick)
        return tick

    def _enter(self, tick: TickContext) -> TickContext:
        """A new state begins at this frame."""
        before, self._entered_state = self._entered_state, self.state
        self._entered = tick.time
        self._parts.motion.restart(tick.time, may_stay=bool({before, self.state} - TO_AND_FRO))
        tick = replace(
            tick,
            since=0.0,
            heading_home=self._machine.heading_home,
            health=replace(tick.health, stopped_moving=False),  # it is a new attempt
        )
        self._behavior.enter(tick, before)
        return tick
