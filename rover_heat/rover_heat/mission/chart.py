"""The mission's states and the events that lead from one to another, as a statechart."""

from __future__ import annotations

from enum import Enum, IntEnum

from statemachine import HistoryState, StateChart
from statemachine import State as ChartState

from rover_decision import statechart
from rover_decision.statechart import StateMachine, Transition


class State(IntEnum):
    """The values are those of rover_interfaces/HeatState."""

    INITIALIZING = 0
    EXPLORING = 1
    TILT_INTERRUPT = 2
    GOAL_NAVIGATION = 3
    LAUNCHING = 4
    ATTEMPTING_RAMP = 5
    RETURNING = 6
    DONE = 7
    PAUSED = 8
    FAILED = 9
    HOLD = 10


class Event(Enum):
    """What can happen to a mission."""

    ready = "all inputs are there, level and air are measured"
    explore = "there is more to see"
    deliver = "a source is to be served"
    at_stand_off = "stands before a source"
    climb = "only the ramp is left"
    go_back = "all is done, the start is left"
    finish = "nothing is left to do"
    tilted = "tilted too far"
    stopped_moving = "no progress although driving"
    recovered = "back on level ground"
    input_gap = "frames were missing, or the pose jumped"
    clock_apart = "the clocks are apart"
    navigator_lost = "the navigator is silent"
    planner_failed = "the planner failed"
    plan_stale = "the plan is too old"
    inputs_restored = "all inputs are fresh again"
    gave_up = "no waiting helps"
    pause = "asked to pause"
    resume = "asked to go on"


class HeatChart(StateChart):
    """Which event leads where; an event that a state does not know changes nothing.

    An interruption returns to the state that it interrupted.
    """

    class working(ChartState.Compound):
        initializing = ChartState(initial=True, value=State.INITIALIZING)
        exploring = ChartState(value=State.EXPLORING)
        goal_navigation = ChartState(value=State.GOAL_NAVIGATION)
        launching = ChartState(value=State.LAUNCHING)
        attempting_ramp = ChartState(value=State.ATTEMPTING_RAMP)
        returning = ChartState(value=State.RETURNING)
        interrupted = HistoryState()
        interrupted.to(initializing)

        ready = initializing.to(exploring)
        explore = exploring.from_(goal_navigation, launching)
        deliver = goal_navigation.from_(exploring, launching)
        at_stand_off = goal_navigation.to(launching)
        climb = attempting_ramp.from_(exploring, goal_navigation, launching)
        go_back = returning.from_(exploring, goal_navigation, launching, attempting_ramp)

    tilt_interrupt = ChartState(value=State.TILT_INTERRUPT)
    hold = ChartState(value=State.HOLD)
    paused = ChartState(value=State.PAUSED)
    failed = ChartState(value=State.FAILED)
    done = ChartState(value=State.DONE, final=True)

    _driving = (
        working.exploring,
        working.goal_navigation,
        working.attempting_ramp,
        working.returning,
    )
    _begun = (*_driving, working.launching)

    finish = done.from_(working, tilt_interrupt, hold, paused, failed)
    tilted = tilt_interrupt.from_(*_begun)
    stopped_moving = tilt_interrupt.from_(*_driving)
    recovered = tilt_interrupt.to(working.interrupted)
    input_gap = hold.from_(*_begun, tilt_interrupt)
    clock_apart = hold.from_(*_begun, tilt_interrupt)
    navigator_lost = hold.from_(*_driving)
    planner_failed = hold.from_(working.exploring, working.goal_navigation)
    plan_stale = hold.from_(working.exploring, working.goal_navigation)
    inputs_restored = hold.to(working.interrupted)
    gave_up = failed.from_(working.initializing, hold)
    pause = paused.from_(working, tilt_interrupt, hold)
    resume = paused.to(working.interrupted) | failed.to(working.interrupted)


class Machine(StateMachine[State, Event]):
    """Where the mission is."""

    def __init__(self) -> None:
        super().__init__(HeatChart, State)

    @property
    def phase(self) -> list[Event]:
        """What leads from the beginning to where a mission stays that is started again.

        All else begins anew: inputs first, then what the agenda says.
        """
        stays = {
            State.DONE: Event.finish,
            State.FAILED: Event.gave_up,
            State.PAUSED: Event.pause,
        }
        return [stays[self.state]] if self.state in stays else []

    def enter(self, phase: list[Event]) -> None:
        """Go where the mission was when that was its phase; only from the beginning."""
        for event in phase:
            self.handle(event)


def transitions() -> set[Transition[State, Event]]:
    """All arrows, those of the groups and of the history taken apart."""
    return statechart.transitions(HeatChart, Event, State)
