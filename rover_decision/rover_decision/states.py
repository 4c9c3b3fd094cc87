"""The mission's states and the events that lead from one to another, as data."""

from __future__ import annotations

from enum import Enum, IntEnum

from statemachine import State as MachineState
from statemachine import StateMachine


class State(IntEnum):
    """The values are those of rover_interfaces/MissionState."""

    IDLE = 0
    FORWARD = 1
    STOP = 2
    ROCK_APPROACH = 3
    PICKUP = 4
    STUCK = 5
    TILT = 7
    RETURN_HOME = 8
    DONE = 9
    PAUSED = 10


class Event(Enum):
    """What can happen to a mission."""

    start = "the first frame has come"
    blocked = "no way ahead"
    cleared = "a way is open"
    rock_seen = "a rock is in reach of the eyes"
    rock_lost = "the rock is gone or given up"
    rock_reached = "a sample is in reach of the arm"
    picked_up = "the sample is on board"
    pickup_failed = "the arm did not start"
    stopped_moving = "no progress although driving"
    tilted = "leaning too far"
    recovered = "the manoeuvre is over"
    finished = "nothing is left to do out here"
    arrived = "home is reached"
    pause = "asked to pause"
    resume = "asked to go on"


class MissionMachine(StateMachine):
    """Which event leads where; an event that a state does not know changes nothing."""

    allow_event_without_transition = True

    idle = MachineState(initial=True, value=State.IDLE)
    forward = MachineState(value=State.FORWARD)
    stop = MachineState(value=State.STOP)
    rock_approach = MachineState(value=State.ROCK_APPROACH)
    pickup = MachineState(value=State.PICKUP)
    stuck = MachineState(value=State.STUCK)
    tilt = MachineState(value=State.TILT)
    return_home = MachineState(value=State.RETURN_HOME)
    done = MachineState(value=State.DONE)
    paused = MachineState(value=State.PAUSED)

    start = idle.to(forward)
    blocked = forward.to(stop)
    cleared = stop.to(forward)
    rock_seen = forward.to(rock_approach) | stop.to(rock_approach)
    rock_lost = rock_approach.to(forward)
    rock_reached = (
        forward.to(pickup) | stop.to(pickup) | rock_approach.to(pickup) | return_home.to(pickup)
    )
    picked_up = pickup.to(forward)
    pickup_failed = pickup.to(forward)
    stopped_moving = (
        forward.to(stuck) | stop.to(stuck) | rock_approach.to(stuck) | return_home.to(stuck)
    )
    tilted = forward.to(tilt) | stop.to(tilt) | rock_approach.to(tilt) | return_home.to(tilt)
    recovered = stuck.to(forward) | tilt.to(forward)
    finished = forward.to(return_home) | stop.to(return_home) | rock_approach.to(return_home)
    arrived = return_home.to(done)
    pause = (
        idle.to(paused)
        | forward.to(paused)
        | stop.to(paused)
        | rock_approach.to(paused)
        | stuck.to(paused)
        | tilt.to(paused)
        | return_home.to(paused)
        | done.to(paused)
    )
    resume = paused.to(forward)


class Machine:
    """The seam to the library: a current state, and events."""

    def __init__(self) -> None:
        self._machine = MissionMachine()

    @property
    def state(self) -> State:
        return State(next(iter(self._machine.configuration)).value)

    def handle(self, event: Event) -> bool:
        """Whether the event led to another state."""
        before = self.state
        self._machine.send(event.name)
        return self.state is not before
