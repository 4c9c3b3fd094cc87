"""The exchange with the server, frame by frame: which telemetry is sent, and when time passes."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Protocol

from rover_simulator.simulation import Simulation
from rover_simulator.wire.unity_client import (
    ANSWERED_EVENTS,
    OPEN,
    ConnectionLostError,
    ProtocolError,
    UnityClient,
)

WAIT = 0.5  # [s] between looks whether to end

Ended = Callable[[], bool]


class Exchange(Protocol):
    """One way for time to pass."""

    def run(self, client: UnityClient, ended: Ended) -> None:
        """Over a fresh connection, until the end; raises what the client raises."""

    def meanwhile(self) -> None:
        """Called often while there is no connection."""


def keep_exchanging(client: UnityClient, exchange: Exchange, ended: Ended) -> None:
    """Connect, and connect again whenever the connection is lost, until the end."""
    while client.connect_until(ended, exchange.meanwhile):
        try:
            exchange.run(client, ended)
        except (ConnectionLostError, ProtocolError) as error:
            client.close()
            print(f"rover sim: {error}; connecting again", file=sys.stderr)
        else:
            client.close(say_goodbye=True)
            return


class FastExchange:
    """As fast as the server answers: one telemetry in flight, and one frame for each answer.

    The two telemetries that the original sends unasked on connecting are both sent and both
    waited for, but answered with one: with one in flight a run depends on the commands alone.
    """

    def __init__(self, simulation: Simulation, on_frame: Callable[[], None]) -> None:
        self._simulation = simulation
        self._on_frame = on_frame

    def run(self, client: UnityClient, ended: Ended) -> None:
        simulation = self._simulation
        client.send_telemetry(simulation.telemetry())
        in_flight = 1
        owed = False  # an answer of the server that is to be answered by the next frame
        while not ended():
            event = client.receive(WAIT)
            if event is None:
                continue
            if event.name == OPEN:
                client.send_telemetry(simulation.telemetry())
                in_flight += 1
            elif event.name in ANSWERED_EVENTS:
                # A command that cannot be parsed is an answer too, but one that gets none.
                in_flight = max(0, in_flight - 1)
                owed |= simulation.handle(event.name, event.data)
            if owed and in_flight == 0:
                simulation.advance()
                self._on_frame()
                client.send_telemetry(simulation.telemetry())
                in_flight, owed = 1, False

    def meanwhile(self) -> None:
        """Time stands still."""


class TimedExchange:
    """Frames at a period of wall time, whether the server answers or not."""

    def __init__(self, simulation: Simulation, on_frame: Callable[[], None], period: float) -> None:
        """period: [s] of wall time between two frames."""
        self._simulation = simulation
        self._on_frame = on_frame
        self._period = period
        self._next_frame: float | None = None  # none before the first connection

    def run(self, client: UnityClient, ended: Ended) -> None:
        simulation = self._simulation
        client.send_telemetry(simulation.telemetry())
        if self._next_frame is None:
            self._next_frame = time.monotonic() + self._period
        tokens = 0  # each is a telemetry that the next frame sends
        while not ended():
            event = client.receive(max(0.0, self._next_frame - time.monotonic()))
            if event is not None:
                tokens += event.name == OPEN or simulation.handle(event.name, event.data)
            if self._advance_when_due():  # also where the events never pause
                telemetry = simulation.telemetry()
                for _ in range(tokens):
                    client.send_telemetry(telemetry)
                tokens = 0

    def meanwhile(self) -> None:
        """The rover drives on by what it was told last, as the original's does."""
        self._advance_when_due()

    def _advance_when_due(self) -> bool:
        now = time.monotonic()
        if self._next_frame is None or now < self._next_frame:
            return False
        # A machine that is too slow runs slower than it should, not ever further behind.
        self._next_frame = max(self._next_frame + self._period, now - self._period)
        self._simulation.advance()
        self._on_frame()
        return True
