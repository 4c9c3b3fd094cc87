"""The machine, over every state and every event."""

from collections import deque

import pytest
from rover_interfaces.msg import MissionState

from rover_decision.states import Event, Machine, MissionMachine, State

SAFE_STATES = {State.IDLE, State.PAUSED, State.DONE}


def machine_in(state: State) -> Machine:
    """A machine brought to a state by the shortest sequence of events."""
    queue: deque[tuple[Event, ...]] = deque([()])
    seen = {State.IDLE}
    while queue:
        events = queue.popleft()
        machine = Machine()
        for event in events:
            machine.handle(event)
        if machine.state is state:
            return machine
        for event in Event:
            trial = Machine()
            for step in (*events, event):
                trial.handle(step)
            if trial.state not in seen:
                seen.add(trial.state)
                queue.append((*events, event))
    raise AssertionError(f"{state.name} cannot be reached")


@pytest.mark.parametrize("state", State)
@pytest.mark.parametrize("event", Event)
def test_every_event_is_taken_in_every_state(state, event):
    machine = machine_in(state)
    changed = machine.handle(event)
    assert machine.state in State
    assert changed == (machine.state is not state)


@pytest.mark.parametrize("state", State)
def test_every_state_has_a_way_out(state):
    def leaves(event: Event) -> bool:
        return machine_in(state).handle(event)

    assert any(leaves(event) for event in Event)


@pytest.mark.parametrize("state", [s for s in State if s not in SAFE_STATES])
def test_pausing_stops_everything_but_the_arm(state):
    machine = machine_in(state)
    machine.handle(Event.pause)
    assert (machine.state is State.PAUSED) == (state is not State.PICKUP)


def test_states_are_those_of_the_message():
    for state in State:
        assert getattr(MissionState, state.name) == state.value


def test_events_of_machine_and_enumeration_agree():
    assert {event.id for event in MissionMachine.events} >= {event.name for event in Event}
