"""How simulated time passes, and which telemetry is sent when, over one connection or several."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Protocol

from rover_simulator.gate import StepGate
from rover_simulator.simulation import Simulation
from rover_simulator.wire.unity_client import (
    ANSWERED_EVENTS,
    OPEN,
    ConnectionLostError,
    ProtocolError,
    UnityClient,
)

POLL_PERIOD = 0.5  # [s] within which an end without an event is noticed
HELD_PERIOD = 0.02  # [s] between two looks whether a frame may be made that is held up

Ended = Callable[[], bool]
Tell = Callable[[str], None]


class Pacing(Protocol):
    """What makes simulated time pass."""

    def run(self, client: UnityClient, ended: Ended) -> None:
        """Serve a new connection until the end; raises what the client raises."""

    def while_disconnected(self) -> None:
        """Called often while there is no connection."""


def print_error(text: str) -> None:
    """As the command line tells it."""
    print(f"rover sim: {text}", file=sys.stderr)


def run_connected(
    client: UnityClient, pacing: Pacing, ended: Ended, tell: Tell = print_error
) -> None:
    """Connect, and connect again whenever the connection is lost, until the end.

    tell: what happens to the connection, in the thread of the caller.
    """
    while _connect(client, pacing, ended, tell):
        try:
            pacing.run(client, ended)
        except (ConnectionLostError, ProtocolError) as error:
            client.close()
            tell(f"{str(error).rstrip('.')}; connecting again")
        else:
            client.close(graceful=True)
            return


def _connect(client: UnityClient, pacing: Pacing, ended: Ended, tell: Tell) -> bool:
    """Whether it was connected before the end; says once that there is no server yet."""
    told = False

    def wait() -> None:
        nonlocal told
        if not told and not client.refused:  # it is told otherwise
            told = True
            tell(f"no server on {client.address}; waiting for one")
        pacing.while_disconnected()

    return client.connect_until(ended, wait)


class LockstepPacing:
    """As fast as the server answers: one telemetry is pending, and each answer makes one frame.

    The original sends two telemetries unasked when it connects. Both are sent and both have to be
    answered, but only one telemetry follows: with one pending, a run depends on the commands alone.
    """

    def __init__(
        self, simulation: Simulation, on_frame: Callable[[], None], gate: StepGate | None = None
    ) -> None:
        """gate: by which frames are held up; open without one."""
        self._simulation = simulation
        self._on_frame = on_frame
        self._gate = gate or StepGate()

    def run(self, client: UnityClient, ended: Ended) -> None:
        simulation = self._simulation
        client.send_telemetry(simulation.telemetry())
        pending = 1  # telemetries that the server has not answered
        accepted = False  # whether an event came that the next frame answers
        while not ended():
            due = accepted and pending == 0  # and held up
            event = client.receive(HELD_PERIOD if due else POLL_PERIOD)
            if event is None:
                self._gate.attend()
            elif event.name == OPEN:
                client.send_telemetry(simulation.telemetry())
                pending += 1
            elif event.name in ANSWERED_EVENTS:
                # A command that cannot be parsed answers a telemetry too, but gets no answer.
                pending = max(0, pending - 1)
                accepted |= simulation.handle(event.name, event.data)
            if accepted and pending == 0 and self._gate.opens():
                simulation.advance()
                self._on_frame()
                client.send_telemetry(simulation.telemetry())
                pending, accepted = 1, False

    def while_disconnected(self) -> None:
        """Simulated time stands still."""
        self._gate.attend()


class TimedPacing:
    """Frames at a period of wall time, whether the server answers or not."""

    def __init__(
        self,
        simulation: Simulation,
        on_frame: Callable[[], None],
        period: float,
        gate: StepGate | None = None,
    ) -> None:
        """period: [s] of wall time between two frames; gate: by which they are held up."""
        self._simulation = simulation
        self._on_frame = on_frame
        self._gate = gate or StepGate()
        self._period = period
        self._next_frame: float | None = None  # None before the first connection

    def run(self, client: UnityClient, ended: Ended) -> None:
        simulation = self._simulation
        client.send_telemetry(simulation.telemetry())
        if self._next_frame is None:
            self._next_frame = time.monotonic() + self._period
        due = 0  # telemetries to send with the next frame
        while not ended():
            event = client.receive(max(0.0, self._next_frame - time.monotonic()))
            if event is not None:
                due += event.name == OPEN or simulation.handle(event.name, event.data)
            if self._advance_when_due():  # also while events arrive without a pause
                telemetry = simulation.telemetry()
                for _ in range(due):
                    client.send_telemetry(telemetry)
                due = 0

    def while_disconnected(self) -> None:
        """The rover drives on under its last command, as in the original."""
        self._advance_when_due()

    def _advance_when_due(self) -> bool:
        now = time.monotonic()
        if self._next_frame is None:
            self._gate.attend()
            return False
        if now < self._next_frame:
            return False
        if not self._gate.opens():
            self._next_frame = now + HELD_PERIOD
            return False
        # A machine that is too slow falls behind real time, but does not try to catch up.
        self._next_frame = max(self._next_frame + self._period, now - self._period)
        self._simulation.advance()
        self._on_frame()
        return True
