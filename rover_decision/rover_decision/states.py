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
    CIRCLE = 6
    TILT = 7
    RETURN_HOME = 8
    DONE = 9
    PAUSED = 10


class Event(Enum):
    """What can happen to a mission."""

    start = "the first frame has come"
    blocked = "no way ahead"
    lost = "frames were missing, or the pose jumped"
    cleared = "a way is open"
    rock_seen = "a rock is near enough to drive to it by sight"
    rock_lost = "the rock is gone or given up"
    rock_reached = "a sample is in reach of the arm"
    picked_up = "the sample is on board"
    pickup_failed = "the arm did not start"
    circling = "has steered to one side for too long"
    stopped_moving = "no progress although driving"
    tilted = "leaning too far"
    recovered = "the manoeuvre is over"
    gave_up = "no manoeuvre helps out here"
    finished = "nothing is left to do out here"
    arrived = "home is reached"
    pause = "asked to pause"
    resume = "asked to go on"


class MissionMachine(StateMachine):
    """Which event leads where; an event that a state does not know changes nothing.

    What was going on when the rover got into trouble goes on after it: the mission sends `finished`
    again when it had been on its way home.
    """

    allow_event_without_transition = True

    idle = MachineState(initial=True, value=State.IDLE)
    forward = MachineState(value=State.FORWARD)
    stop = MachineState(value=State.STOP)
    rock_approach = MachineState(value=State.ROCK_APPROACH)
    pickup = MachineState(value=State.PICKUP)
    stuck = MachineState(value=State.STUCK)
    circle = MachineState(value=State.CIRCLE)
    tilt = MachineState(value=State.TILT)
    return_home = MachineState(value=State.RETURN_HOME)
    done = MachineState(value=State.DONE)
    paused = MachineState(value=State.PAUSED)

    start = idle.to(forward)
    blocked = forward.to(stop) | circle.to(stop)
    lost = forward.to(stop) | circle.to(stop) | rock_approach.to(stop) | return_home.to(stop)
    cleared = stop.to(forward)
    rock_seen = forward.to(rock_approach) | stop.to(rock_approach) | circle.to(rock_approach)
    rock_lost = rock_approach.to(forward)
    rock_reached = (
        forward.to(pickup)
        | stop.to(pickup)
        | circle.to(pickup)
        | rock_approach.to(pickup)
        | return_home.to(pickup)
    )
    picked_up = pickup.to(forward)
    pickup_failed = pickup.to(forward)
    circling = forward.to(circle)
    stopped_moving = (
        forward.to(stuck)
        | stop.to(stuck)
        | circle.to(stuck)
        | rock_approach.to(stuck)
        | return_home.to(stuck)
    )
    tilted = (
        forward.to(tilt)
        | stop.to(tilt)
        | circle.to(tilt)
        | rock_approach.to(tilt)
        | return_home.to(tilt)
    )
    recovered = stuck.to(forward) | tilt.to(forward) | circle.to(forward)
    gave_up = stuck.to(return_home)
    finished = (
        forward.to(return_home)
        | stop.to(return_home)
        | circle.to(return_home)
        | rock_approach.to(return_home)
    )
    arrived = return_home.to(done)
    pause = (
        idle.to(paused)
        | forward.to(paused)
        | stop.to(paused)
        | circle.to(paused)
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
