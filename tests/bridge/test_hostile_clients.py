"""The socket server beside clients that harm: it serves the others, and tells why it refuses."""

from __future__ import annotations

import json
import socket
import struct
import time
from collections.abc import Callable, Iterator
from queue import Queue

import pytest
import websocket
from flooders import HANDSHAKE, frame, open_websocket, running
from telemetry import telemetry

from rover_bridge import connections, flow_control
from rover_bridge.flow_control import BURST, MAX_OWED
from rover_bridge.server import SocketServer
from rover_bridge.transport import (
    Connected,
    ConnectionRefused,
    Disconnected,
    ProtocolErrorReported,
    ServerEvent,
    TelemetryReceived,
    WireLimits,
)
from rover_bridge.wire_format import MAX_MESSAGE_BYTES
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


@pytest.fixture
def serve() -> Iterator[Callable[..., Answering]]:
    started: list[Answering] = []

    def start(**limits: float) -> Answering:
        started.append(Answering(WireLimits(**limits)))
        return started[-1]

    yield start
    for answering in started:
        answering.server.close()


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


@pytest.mark.parametrize("clients", [1, 8])
def test_a_simulator_is_answered_beside_a_flood(serve, clients):
    answering = serve(client_rate=100.0)
    start = time.monotonic()
    with running("flood", answering.port, "--clients", clients, "--seconds", WAIT):
        assert answers(answering.port, 20) == 20
    took = time.monotonic() - start
    read = len(answering.so_far(TelemetryReceived))
    assert read <= 20 + clients * (BURST + 1 + 100.0 * took)


def test_a_client_that_reads_no_answer_is_read_no_further(serve, monkeypatch):
    monkeypatch.setattr(flow_control, "STALL_SECONDS", 0.5)
    answering = serve()
    answering.answering = False
    with open_websocket(answering.port) as raw:
        raw.sendall(event("telemetry", {}) * (3 * MAX_OWED))
        data = read_all(raw)
    assert len(answering.so_far(TelemetryReceived)) == MAX_OWED
    assert "does not read its answers" in closing(data)[1]


@pytest.mark.parametrize("kind", ["tcp", "websocket"])
def test_connections_that_are_silent_make_room(serve, monkeypatch, kind):
    monkeypatch.setattr(connections, "HEADER_SECONDS", WAIT)
    limit = 6
    answering = serve(max_connections=limit)
    with running(kind, answering.port, "--clients", 3 * limit, "--seconds", WAIT):
        assert answers(answering.port, 3) == 3
    refused = answering.so_far(ConnectionRefused)
    assert len(refused) >= 2 * limit + 1
    assert all("silent for longest" in refusal.reason for refusal in refused)


def test_a_simulator_does_not_make_room_and_a_new_one_is_told(serve):
    answering = serve(max_connections=2)
    drivers = [open_websocket(answering.port) for _ in range(2)]
    for driver in drivers:
        driver.sendall(event("telemetry", {}))
        answering.next(TelemetryReceived)
    with socket.create_connection(("127.0.0.1", answering.port)) as raw:
        raw.sendall(HANDSHAKE.encode())
        answer = read_all(raw)
    assert answer.startswith(b"HTTP/1.1 503 ")
    assert b"too many connections: 2 are open" in answer
    answering.next(ConnectionRefused)
    for driver in drivers:
        driver.sendall(event("telemetry", {}))
        answering.next(TelemetryReceived)
        driver.close()


@pytest.mark.parametrize("sent", [b"", b"GET / HTTP/1.1\r\nHost: x\r\n"])
def test_headers_that_do_not_come_end_the_connection(serve, monkeypatch, sent):
    monkeypatch.setattr(connections, "HEADER_SECONDS", 0.3)
    with socket.create_connection(("127.0.0.1", serve().port)) as raw:
        raw.sendall(sent)
        answer = read_all(raw)
    assert answer.startswith(b"HTTP/1.1 408 ")
    assert b"headers are not whole" in answer


@pytest.mark.parametrize("sent", [b"", frame("2")[:3]])
def test_a_websocket_without_a_message_is_closed_and_told(serve, sent):
    answering = serve(idle_limit=1.0)
    with open_websocket(answering.port) as raw:
        raw.sendall(frame("40") + sent)
        data = read_all(raw)
    assert closing(data) == (1001, "no message in 1 s")
    answering.next(Disconnected)


def test_a_polling_session_that_is_silent_ends(serve):
    answering = serve(idle_limit=1.0)
    with socket.create_connection(("127.0.0.1", answering.port)) as raw:
        raw.sendall(b"GET /socket.io/?EIO=4&transport=polling HTTP/1.1\r\nHost: x\r\n\r\n")
        raw.settimeout(WAIT)
        answer = raw.recv(4096).decode()
        sid = json.loads(answer[answer.index("{") : answer.index("}") + 1])["sid"]
        post = f"POST /socket.io/?EIO=4&transport=polling&sid={sid} HTTP/1.1\r\nHost: x\r\n"
        raw.sendall(f"{post}Content-Length: 2\r\n\r\n40".encode())
        answering.next(Connected)
    answering.next(Disconnected)


def test_events_with_the_names_of_the_librarys_own_change_nothing(serve):
    answering = serve()
    with open_websocket(answering.port) as raw:
        raw.sendall(event("telemetry", {}))
        answering.next(TelemetryReceived)
        raw.sendall(event("disconnect") + event("connect", {}) + frame("40") + event("other", 1))
        raw.sendall(event("telemetry", {"number": "2"}))
        later = []
        while not isinstance(received := answering.events.get(timeout=WAIT), TelemetryReceived):
            later.append(received)
        assert later == []
        assert received.wire == {"number": "2"}


def test_an_integer_of_any_length_is_handed_over(serve):
    answering = serve()
    with open_websocket(answering.port) as raw:
        raw.sendall(frame('42["telemetry",{"speed":' + "9" * 5000 + "}]"))
        received = answering.next(TelemetryReceived)
        assert received.wire == {"speed": float("inf")}


@pytest.mark.parametrize(
    "garbage",
    [
        frame(""),
        frame("hello"),
        frame("4[" + "[" * 500),
        frame('42["telemetry",' + "[" * 5000),
        frame("451-[]"),
        frame("42[", opcode=2),
        frame("4" + "2" * 300_000),
        frame("x", opcode=3),
        frame('42["telemetry",{}]')[:1] + b"\x10" + b"x" * 16,  # not masked
    ],
    ids=range(9),
)
def test_garbage_ends_the_connection_of_a_client_that_has_joined(serve, garbage):
    answering = serve()
    with open_websocket(answering.port) as raw:
        raw.sendall(event("telemetry", {}))
        answering.next(TelemetryReceived)
        raw.sendall(garbage)
        answering.next(Disconnected)
        read_all(raw)
    assert answers(answering.port, 1) == 1


def test_a_message_of_many_frames_is_bounded(serve):
    answering = serve()
    part = "x" * 2**20
    with open_websocket(answering.port) as raw:
        raw.sendall(frame("42" + part, final=False))
        for _ in range(MAX_MESSAGE_BYTES // len(part)):
            raw.sendall(frame(part, opcode=0, final=False))
        assert closing(read_all(raw))[0] == 1009
    assert answering.so_far(ProtocolErrorReported) == []


def test_no_compression_is_agreed_on(serve):
    raw = websocket.create_connection(
        f"ws://127.0.0.1:{serve().port}/socket.io/?EIO=4&transport=websocket",
        header=["Sec-WebSocket-Extensions: permessage-deflate"],
        timeout=WAIT,
    )
    assert "sec-websocket-extensions" not in raw.headers
    raw.shutdown()
