"""Makes the faults of a plan come: signals to processes, clients of the wire, junk in the graph."""

from __future__ import annotations

import os
import random
import signal
import threading
from collections.abc import Callable
from typing import Protocol

from rover_tools.chaos import wire_client
from rover_tools.chaos.executor import End
from rover_tools.chaos.plan import Fault, Kind
from rover_tools.chaos.wire_client import Stopped

JOIN_SECONDS = 10.0  # [s] for a client to see that it is to end


class Nodes(Protocol):
    """The processes of a run."""

    def pid(self, name: str) -> int:
        """Of the named process."""


Publish = Callable[[str, Stopped], int]


class Faults:
    """`begin` is what an executor asks for."""

    def __init__(self, nodes: Nodes, port: int, publish: Publish, seed: int) -> None:
        """port: the bridge's; publish: sends a shape to the graph until it is stopped."""
        self._nodes = nodes
        self._port = port
        self._publish = publish
        self._seed = seed

    def begin(self, fault: Fault) -> End:
        """Make it come; returns what ends it."""
        if fault.kind in (Kind.KILL, Kind.STOP):
            return self._signal(fault)
        return _in_thread(lambda stopped: self._send(fault, stopped))

    def _signal(self, fault: Fault) -> End:
        pid = self._nodes.pid(fault.target)
        if fault.kind is Kind.KILL:
            _kill(pid, signal.SIGKILL)
            return lambda: None
        _kill(pid, signal.SIGSTOP)
        return lambda: _kill(pid, signal.SIGCONT)

    def _send(self, fault: Fault, stopped: Stopped) -> int:
        """How many messages or connections."""
        if fault.kind is Kind.FLOOD:
            return wire_client.flood(self._port, int(fault.target.split()[0]), stopped)
        if fault.kind is Kind.IDLE:
            return wire_client.hold(self._port, fault.target == "websocket", stopped)
        if fault.kind is Kind.GRAPH:
            return self._publish(fault.target, stopped)
        chance = random.Random(f"bytes {self._seed} {fault.number}")
        return wire_client.send_shapes(self._port, fault.target, chance, stopped)


def _kill(pid: int, number: signal.Signals) -> None:
    """A process that has just ended by itself needs no signal; it is told elsewhere."""
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        return


def _in_thread(work: Callable[[Stopped], int]) -> End:
    ended = threading.Event()
    thread = threading.Thread(target=work, args=(ended.is_set,), name="fault", daemon=True)
    thread.start()

    def end() -> None:
        ended.set()
        thread.join(JOIN_SECONDS)

    return end
