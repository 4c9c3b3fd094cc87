"""Clients of the bridge for tests, and a node that answers its frames."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

import pytest
import socketio
from rclpy.node import Node
from rover_interfaces.msg import DriveCommand, RoverStatus
from telemetry import telemetry

from rover_common import topics
from rover_common.ros import conversions, qos
from rover_common.types import Command
from rover_simulator.wire.unity_client import OPEN, Event, UnityClient

DRIVE = Command(throttle=0.25, steering_angle=0.1)
WAIT = 10.0  # [s] what a client waits at most for an answer
QUIET = 0.5  # [s] in which no further answer comes


class Decider(Node):
    """Answers every status at once, with a command that a test may change."""

    def __init__(self, command: Command = DRIVE, **kwargs: Any) -> None:
        super().__init__("decider", **kwargs)
        self.command = command
        self.statuses: list[RoverStatus] = []
        self._publisher = self.create_publisher(DriveCommand, topics.COMMAND, qos.FRAME)
        self.create_subscription(RoverStatus, topics.STATUS, self._on_status, qos.FRAME)

    def _on_status(self, status: RoverStatus) -> None:
        self.statuses.append(status)
        stamp, run = conversions.stamp_of(status.header.stamp), conversions.run_of(status)
        self._publisher.publish(conversions.command_message_of(0, stamp, run, self.command))


class InThread:
    """Runs a client beside the executor and keeps what it returned or raised."""

    def __init__(self, body: Callable[[], Any]) -> None:
        self.result: Any = None
        self.error: BaseException | None = None

        def run() -> None:
            try:
                self.result = body()
            except BaseException as error:
                self.error = error

        self._thread = threading.Thread(target=run)
        self._thread.start()

    def done(self) -> bool:
        return not self._thread.is_alive()

    def get(self) -> Any:
        self._thread.join()
        if self.error is not None:
            raise self.error
        return self.result


def run_clients(ros: Any, *bodies: Callable[[], Any]) -> list[Any]:
    """Run clients in threads while the nodes spin; what each returned."""
    clients = [InThread(body) for body in bodies]
    assert ros.spin_until(lambda: all(client.done() for client in clients), timeout=120)
    return [client.get() for client in clients]


class Unity:
    """The simulator's side of a connection, one request at a time."""

    def __init__(self, port: int) -> None:
        self._client = UnityClient("127.0.0.1", port)

    def __enter__(self) -> Unity:
        self._client.connect(timeout=5)
        return self

    def __exit__(self, *_: object) -> None:
        self._client.close()

    def send(self, wire: Mapping[str, Any]) -> None:
        self._client.send_telemetry(dict(wire))

    def next_answer(self, timeout: float = WAIT) -> Event | None:
        """The next event of the server but for its open packet; None when none comes."""
        while (event := self._client.receive(timeout)) and event.name == OPEN:
            pass
        return event

    def ask(self, wire: Mapping[str, Any]) -> Event:
        """Send a telemetry and wait for its answer."""
        self.send(wire)
        event = self.next_answer()
        assert event is not None
        return event


def answers_to(ros: Any, port: int, *wires: Mapping[str, Any]) -> list[Event]:
    """The answers to these telemetries of one Unity client, sent one after the other."""

    def body() -> list[Event]:
        with Unity(port) as unity:
            return [unity.ask(wire) for wire in wires]

    (events,) = run_clients(ros, body)
    return list(events)


def unity_answers(port: int, count: int) -> list[dict[str, str]]:
    """Answers to `count` telemetries of a Unity client: two of them unasked, then one each."""
    client = UnityClient("127.0.0.1", port)
    client.connect(timeout=5)
    answers: list[dict[str, str]] = []
    client.send_telemetry(telemetry())
    sent = 1
    try:
        while len(answers) < count:
            event = client.receive(timeout=WAIT)
            assert event is not None, f"no answer after {len(answers)} of {sent}"
            if event.name != OPEN:
                assert event.name == "data"
                answers.append(dict(event.data))
            if sent < count:
                client.send_telemetry(telemetry())
                sent += 1
        assert client.receive(timeout=QUIET) is None, "more answers than telemetries"
    finally:
        client.close(graceful=True)
    return answers


def modern_answers(port: int, count: int) -> list[dict[str, str]]:
    """Answers to `count` telemetries of python-socketio's own client."""
    answers = []
    with socketio.SimpleClient() as client:
        client.connect(f"http://127.0.0.1:{port}", transports=["websocket"])
        for _ in range(count):
            client.emit("telemetry", telemetry())
            name, data = client.receive(timeout=WAIT)
            assert name == "data"
            answers.append(data)
        with pytest.raises(socketio.exceptions.TimeoutError):
            client.receive(timeout=QUIET)
    return answers
