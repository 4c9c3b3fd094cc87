"""A socket server that answers by itself, and what tests send to it and read from it."""

from __future__ import annotations

import json
import socket
import struct
from queue import Queue

from flooders import frame
from telemetry import telemetry

from rover_bridge.server import SocketServer
from rover_bridge.transport import ServerEvent, TelemetryReceived, WireLimits
from rover_simulator.wire.unity_client import OPEN, UnityClient

WAIT = 60.0  # [s] what a test waits at most; a busy machine is slow
DRIVE = {"steering_angle": "0", "throttle": "0", "brake": "1"}


class Answering:
    """A server that answers each telemetry at once, and keeps what else happened."""

    def __init__(self, limits: WireLimits) -> None:
        self.events: Queue[ServerEvent] = Queue()
        self.answering = True
        self.server = SocketServer("127.0.0.1", 0, self._on_event, limits)
        self.port = self.server.port

    def _on_event(self, event: ServerEvent) -> None:
        self.events.put(event)
        if self.answering and isinstance(event, TelemetryReceived):
            self.server.send(event.client, "data", DRIVE)

    def next(self, kind: type, count: int = 1) -> ServerEvent:
        """The next event of this kind, or the one that makes so many."""
        while True:
            event = self.events.get(timeout=WAIT)
            if isinstance(event, kind):
                count -= 1
                if count == 0:
                    return event

    def so_far(self, kind: type) -> list[ServerEvent]:
        events = [self.events.get_nowait() for _ in range(self.events.qsize())]
        return [event for event in events if isinstance(event, kind)]


def answers(port: int, count: int) -> int:
    """How many of so many telemetries of a new simulator are answered, one after the other."""
    client = UnityClient("127.0.0.1", port)
    client.connect(timeout=WAIT)
    try:
        for done in range(count):
            client.send_telemetry(telemetry())
            while (event := client.receive(timeout=WAIT)) and event.name == OPEN:
                pass
            if event is None:
                return done
        return count
    finally:
        client.close()


def read_all(connection: socket.socket) -> bytes:
    """What comes until the server ends the connection."""
    connection.settimeout(WAIT)
    data = b""
    try:
        while part := connection.recv(4096):
            data += part
    except ConnectionError:
        pass
    return data


def closing(data: bytes) -> tuple[int, str]:
    """Status and reason of the closing frame at the end of what a WebSocket received."""
    start = data.rindex(b"\x88")
    (status,) = struct.unpack("!H", data[start + 2 : start + 4])
    return status, data[start + 4 :].decode()


def event(name: str, *data: object) -> bytes:
    return frame("42" + json.dumps([name, *data]))
