"""The mission's states and the events that lead from one to another, as a statechart."""

from __future__ import annotations

from enum import Enum, IntEnum

from statemachine import HistoryState, StateChart
from statemachine import State as ChartState

from rover_decision import statechart
from rover_decision.statechart import StateMachine, Transition


class State(IntEnum):
    """The values are those of rover_interfaces/MissionState."""

    IDLE = 0
    FORWARD = 1
    STOP = 2
    ROCK_APPROACH = 3
    PICKUP = 4
    STUCK = 5
    CIRCLE = 6
    TILT = 7
    RETURN_HOME = 8
    DONE = 9
    PAUSED = 10
    HOLD = 11


class Event(Enum):
    """What can happen to a mission."""

    start = "the first frame has come"
    blocked = "no free ground ahead"
    cleared = "the ground ahead is free again"
    rock_seen = "a rock is near enough to drive to it by sight"
    rock_lost = "the rock is gone or given up"
    rock_reached = "a sample is in reach of the arm"
    picked_up = "the sample is on board"
    pickup_failed = "the arm did not start"
    circling = "has steered to one side for too long"
    stopped_moving = "no progress although driving"
    tilted = "tilted too far"
    input_gap = "frames were missing, or the pose jumped"
    planner_failed = "the planner failed"
    plan_stale = "the plan is too old"
    map_stale = "the map is too old"
    inputs_restored = "all inputs are fresh again"
    recovered = "the manoeuvre is over"
    gave_up = "no manoeuvre and no waiting helps"
    finished = "nothing is left to do out here"
    arrived = "home is reached"
    pause = "asked to pause"
    resume = "asked to go on"


class MissionChart(StateChart):
    """Which event leads where; an event that a state does not know changes nothing.

    The mission explores, then heads home. What interrupts it, a pickup, a recovery or a pause,
    returns to the phase that it interrupted.
    """

    class driving(ChartState.Compound):
        class exploring(ChartState.Compound):
            forward = ChartState(initial=True, value=State.FORWARD)
            stop = ChartState(value=State.STOP)
            rock_approach = ChartState(value=State.ROCK_APPROACH)
            circle = ChartState(value=State.CIRCLE)

            blocked = stop.from_(forward, circle)
            cleared = stop.to(forward)
            rock_seen = rock_approach.from_(forward, stop, circle)
            rock_lost = rock_approach.to(forward)
            circling = forward.to(circle)
            recovered = circle.to(forward)

        class heading_home(ChartState.Compound):
            return_home = ChartState(initial=True, value=State.RETURN_HOME)

        phase = HistoryState()
        phase.to(exploring)
        finished = exploring.to(heading_home)

    idle = ChartState(initial=True, value=State.IDLE)
    pickup = ChartState(value=State.PICKUP)
    stuck = ChartState(value=State.STUCK)
    tilt = ChartState(value=State.TILT)
    hold = ChartState(value=State.HOLD)
    paused = ChartState(value=State.PAUSED)
    done = ChartState(value=State.DONE)

    start = idle.to(driving.exploring)
    rock_reached = driving.to(pickup)
    stopped_moving = driving.to(stuck)
    tilted = driving.to(tilt)
    input_gap = driving.to(hold)
    planner_failed = driving.exploring.to(hold)
    plan_stale = driving.exploring.to(hold)
    map_stale = driving.exploring.to(hold)
    picked_up = pickup.to(driving.phase)
    pickup_failed = pickup.to(driving.phase)
    inputs_restored = hold.to(driving.phase)
    recovered = stuck.to(driving.phase) | tilt.to(driving.phase)
    gave_up = driving.heading_home.from_(stuck, hold)
    arrived = driving.heading_home.to(done)
    pause = paused.from_(idle, driving, stuck, tilt, hold, done)
    resume = paused.to(driving.phase)


class Machine(StateMachine[State, Event]):
    """Where the mission is; also whether it heads home."""

    def __init__(self, chart: type[StateChart] = MissionChart) -> None:
        super().__init__(chart, State)

    @property
    def heading_home(self) -> bool:
        """Whether the rover heads home, or will when what interrupted that is over."""
        if self.active & {"exploring", "heading_home"}:
            return "heading_home" in self.active
        return "heading_home" in self.interrupted("phase")

    @property
    def phase(self) -> list[Event]:
        """What leads from the beginning to where the mission is, but for what interrupts it."""
        over = self.state is State.DONE
        happened = {
            Event.start: self.state is not State.IDLE,
            Event.finished: self.heading_home or over,
            Event.arrived: over,
            Event.pause: self.state is State.PAUSED,
        }
        return [event for event, has in happened.items() if has]

    def enter(self, phase: list[Event]) -> None:
        """Go where the mission was when that was its phase; only from the beginning."""
        for event in phase:
            self.handle(event)


def transitions(chart: type[StateChart] = MissionChart) -> set[Transition[State, Event]]:
    """All arrows, those of the groups and of the history taken apart."""
    return statechart.transitions(chart, Event, State)
