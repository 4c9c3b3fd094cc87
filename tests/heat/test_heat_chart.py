"""Every state with every event: where it leads, and that all else leads nowhere."""

from __future__ import annotations

import pytest
from rover_interfaces.msg import HeatState

from rover_heat.mission.chart import Event, HeatChart, Machine, State, transitions

S, E = State, Event
WORKING = (S.INITIALIZING, S.EXPLORING, S.GOAL_NAVIGATION, S.LAUNCHING, S.ATTEMPTING_RAMP,
           S.RETURNING)  # fmt: skip
TO_START = {
    S.INITIALIZING: (),
    S.EXPLORING: (E.ready,),
    S.GOAL_NAVIGATION: (E.ready, E.deliver),
    S.LAUNCHING: (E.ready, E.deliver, E.at_stand_off),
    S.ATTEMPTING_RAMP: (E.ready, E.climb),
    S.RETURNING: (E.ready, E.go_back),
}
MOVES = {
    S.INITIALIZING: {E.ready: S.EXPLORING, E.gave_up: S.FAILED},
    S.EXPLORING: {E.deliver: S.GOAL_NAVIGATION, E.climb: S.ATTEMPTING_RAMP, E.go_back: S.RETURNING},
    S.GOAL_NAVIGATION: {
        E.at_stand_off: S.LAUNCHING, E.explore: S.EXPLORING, E.climb: S.ATTEMPTING_RAMP,
        E.go_back: S.RETURNING,
    },
    S.LAUNCHING: {
        E.deliver: S.GOAL_NAVIGATION, E.explore: S.EXPLORING, E.climb: S.ATTEMPTING_RAMP,
        E.go_back: S.RETURNING,
    },
    S.ATTEMPTING_RAMP: {E.go_back: S.RETURNING},
    S.RETURNING: {},
}  # fmt: skip
HOLDS = {
    E.input_gap: {S.EXPLORING, S.GOAL_NAVIGATION, S.LAUNCHING, S.ATTEMPTING_RAMP, S.RETURNING},
    E.clock_apart: {S.EXPLORING, S.GOAL_NAVIGATION, S.LAUNCHING, S.ATTEMPTING_RAMP, S.RETURNING},
    E.navigator_lost: {S.EXPLORING, S.GOAL_NAVIGATION, S.ATTEMPTING_RAMP, S.RETURNING},
    E.planner_failed: {S.EXPLORING, S.GOAL_NAVIGATION},
    E.plan_stale: {S.EXPLORING, S.GOAL_NAVIGATION},
}
TILTS = {
    E.tilted: {S.EXPLORING, S.GOAL_NAVIGATION, S.LAUNCHING, S.ATTEMPTING_RAMP, S.RETURNING},
    E.stopped_moving: {S.EXPLORING, S.GOAL_NAVIGATION, S.ATTEMPTING_RAMP, S.RETURNING},
}
# interruptions of a state that works, and what ends each
ENDS = {S.TILT_INTERRUPT: E.recovered, S.HOLD: E.inputs_restored, S.PAUSED: E.resume,
        S.FAILED: E.resume}  # fmt: skip
INTO = {S.TILT_INTERRUPT: (E.tilted,), S.HOLD: (E.input_gap,), S.PAUSED: (E.pause,),
        S.FAILED: (E.input_gap, E.gave_up)}  # fmt: skip


def expected(state: State, event: Event) -> State:
    """Of a state that works."""
    if event is E.finish:
        return S.DONE
    if event is E.pause:
        return S.PAUSED
    for table, target in ((HOLDS, S.HOLD), (TILTS, S.TILT_INTERRUPT)):
        if state in table.get(event, ()):
            return target
    return MOVES[state].get(event, state)


def machine_in(*events: Event) -> Machine:
    machine = Machine()
    for event in events:
        assert machine.handle(event), event
    return machine


@pytest.mark.parametrize("event", Event, ids=lambda event: event.name)
@pytest.mark.parametrize("state", WORKING, ids=lambda state: state.name)
def test_a_state_that_works(state, event):
    machine = machine_in(*TO_START[state])
    assert machine.state is state
    changed = machine.handle(event)
    assert machine.state is expected(state, event)
    assert changed == (machine.state is not state)


@pytest.mark.parametrize("event", Event, ids=lambda event: event.name)
@pytest.mark.parametrize(
    ("before", "state"),
    [
        (before, state)
        for before in WORKING
        for state in ENDS
        if before is not S.INITIALIZING or state in (S.PAUSED, S.FAILED)
    ],
    ids=lambda state: state.name,
)
def test_an_interruption(before, state, event):
    machine = machine_in(*TO_START[before])
    into = (E.gave_up,) if before is S.INITIALIZING and state is S.FAILED else INTO[state]
    for step in into:
        machine.handle(step)
    assert machine.state is state
    machine.handle(event)
    wanted = state
    if event is ENDS[state]:
        wanted = before
    elif event is E.finish:
        wanted = S.DONE
    elif event is E.pause and state in (S.TILT_INTERRUPT, S.HOLD):
        wanted = S.PAUSED
    elif event is E.gave_up and state is S.HOLD:
        wanted = S.FAILED
    elif event in (E.input_gap, E.clock_apart) and state is S.TILT_INTERRUPT:
        wanted = S.HOLD
    assert machine.state is wanted


@pytest.mark.parametrize("event", Event, ids=lambda event: event.name)
def test_what_is_over_stays_over(event):
    machine = machine_in(E.ready, E.finish)
    assert not machine.handle(event)
    assert machine.state is S.DONE


def test_an_interruption_of_an_interruption_returns_to_what_worked():
    machine = machine_in(E.ready, E.deliver, E.tilted, E.input_gap, E.pause, E.resume)
    assert machine.state is S.GOAL_NAVIGATION
    assert machine_in(E.pause, E.resume).state is S.INITIALIZING
    assert machine_in(E.gave_up, E.resume).state is S.INITIALIZING


def test_the_arrows_are_those_that_were_walked():
    arrows = {(t.source, t.event, t.target) for t in transitions()}
    for state in WORKING:
        for event in Event:
            target = expected(state, event)
            assert ((state, event, target) in arrows) == (target is not state)
    assert {(t.source, t.event) for t in transitions() if t.source not in WORKING} == {
        (S.TILT_INTERRUPT, E.recovered), (S.TILT_INTERRUPT, E.input_gap),
        (S.TILT_INTERRUPT, E.clock_apart), (S.TILT_INTERRUPT, E.pause),
        (S.TILT_INTERRUPT, E.finish), (S.HOLD, E.inputs_restored), (S.HOLD, E.gave_up),
        (S.HOLD, E.pause), (S.HOLD, E.finish), (S.PAUSED, E.resume), (S.PAUSED, E.finish),
        (S.FAILED, E.resume), (S.FAILED, E.finish),
    }  # fmt: skip


def test_states_are_those_of_the_message():
    for state in State:
        assert getattr(HeatState, state.name) == state.value


def test_the_chart_knows_each_event_and_no_other():
    assert {event.id for event in HeatChart.events} == {event.name for event in Event}
