"""The socket server alone: it leaves nothing open, and what it sends and receives is whole."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from queue import Queue

import pytest
import socketio
import websocket
from eventlet.websocket import RFC6455WebSocket
from hypothesis import given
from hypothesis import strategies as st
from telemetry import telemetry
from waiting import holds

from rover_bridge.server import SocketServer
from rover_bridge.transport import (
    Connected,
    Disconnected,
    PortInUseError,
    ProtocolErrorReported,
    ServerEvent,
    TelemetryReceived,
)
from rover_bridge.wire_websocket import apply_mask
from rover_common.errors import CANNOT_START
from rover_simulator.wire.unity_client import ConnectionLostError, UnityClient

Events = Queue[ServerEvent]


@pytest.fixture
def events() -> Events:
    return Queue()


@pytest.fixture
def server(events: Events) -> Iterator[SocketServer]:
    server = SocketServer("127.0.0.1", 0, events.put)
    yield server
    server.close()


def url(port: int, query: str = "EIO=4&transport=websocket") -> str:
    return f"ws://127.0.0.1:{port}/socket.io/?{query}"


def next_telemetry(events: Events) -> TelemetryReceived:
    while not isinstance(event := events.get(timeout=10), TelemetryReceived):
        pass
    return event


def open_files() -> int:
    return len(list(Path("/proc/self/fd").iterdir()))


def serve_once() -> None:
    """Start and close a server with a client of each protocol, and one that sends nothing."""
    events: Events = Queue()
    server = SocketServer("127.0.0.1", 0, events.put)
    unity = UnityClient("127.0.0.1", server.port)
    unity.connect(timeout=5)
    unity.send_telemetry(telemetry())
    client = next_telemetry(events).client
    server.send(client, "data", {"throttle": "0"})
    mute = websocket.create_connection(url(server.port), timeout=5)
    with socketio.SimpleClient(reconnection=False) as modern:
        modern.connect(f"http://127.0.0.1:{server.port}", transports=["websocket"])
        server.close()
    unity.close()
    mute.shutdown()


@pytest.mark.skipif(sys.platform != "linux", reason="counts the open files in /proc")
def test_a_closed_server_leaves_no_thread_and_no_open_file():
    serve_once()  # what libraries open once and keep
    files, threads = open_files(), threading.active_count()
    for _ in range(5):
        serve_once()
    # One of another test may end meanwhile, and on a busy machine a client's thread ends later.
    assert holds(lambda: threading.active_count() <= threads, 10.0)
    assert holds(lambda: open_files() <= files, 10.0)


def test_the_port_is_free_again_after_closing(events):
    first = SocketServer("127.0.0.1", 0, events.put)
    client = UnityClient("127.0.0.1", first.port)
    client.connect(timeout=5)
    first.close()
    second = SocketServer("127.0.0.1", first.port, events.put)
    second.close()
    client.close()


def test_a_client_notices_that_the_server_has_closed(events):
    server = SocketServer("127.0.0.1", 0, events.put)
    client = UnityClient("127.0.0.1", server.port)
    client.connect(timeout=5)
    client.send_telemetry(telemetry())
    next_telemetry(events)
    server.close()
    with pytest.raises(ConnectionLostError):
        while client.receive(timeout=10) is not None:
            pass
    client.close()


def test_sending_to_a_client_that_has_disconnected_is_harmless(server, events):
    client = UnityClient("127.0.0.1", server.port)
    client.connect(timeout=5)
    client.send_telemetry(telemetry())
    gone = next_telemetry(events).client
    client.close()
    while not isinstance(events.get(timeout=10), Disconnected):
        pass
    server.send(gone, "data", {})
    server.send("nobody", "data", {})
    with socketio.SimpleClient() as modern:
        modern.connect(f"http://127.0.0.1:{server.port}", transports=["websocket"])
        modern.emit("telemetry", {"alive": "1"})
        assert next_telemetry(events).wire == {"alive": "1"}


@pytest.mark.parametrize("transports", [["polling"], ["polling", "websocket"], ["websocket"]])
def test_modern_clients_connect_by_any_transport(server, events, transports):
    if "polling" in transports:
        pytest.importorskip("requests", reason="the client's polling transport needs requests")
    with socketio.SimpleClient() as client:
        client.connect(f"http://127.0.0.1:{server.port}", transports=transports)
        client.emit("telemetry", telemetry())
        received = next_telemetry(events)
        assert received.wire == telemetry()
        server.send(received.client, "data", {"throttle": "0"})
        assert client.receive(timeout=10) == ["data", {"throttle": "0"}]


def test_a_legacy_client_is_connected_unasked(server, events):
    raw = websocket.create_connection(
        url(server.port, "transport=websocket&EIO=3"), suppress_origin=True, timeout=5
    )
    assert str(raw.recv()).startswith("0{")
    assert str(raw.recv()).startswith("40")
    assert isinstance(events.get(timeout=10), Connected)
    raw.close()


def test_another_version_of_engineio_is_refused(server):
    with pytest.raises(websocket.WebSocketBadStatusException):
        websocket.create_connection(url(server.port, "EIO=2&transport=websocket"), timeout=5)


@pytest.mark.parametrize("garbage", ["", "hello", "42[", "4", "42{}", "451-[]", "\x00\xff"])
def test_garbage_is_reported_or_ignored_and_others_are_served(server, events, capfd, garbage):
    raw = websocket.create_connection(url(server.port), timeout=5)
    raw.send(garbage)
    with socketio.SimpleClient() as modern:
        modern.connect(f"http://127.0.0.1:{server.port}", transports=["websocket"])
        modern.emit("telemetry", {"alive": "1"})
        assert next_telemetry(events).wire == {"alive": "1"}
    raw.shutdown()
    assert capfd.readouterr().err == ""


def test_a_message_of_neither_protocol_is_reported(server, events):
    raw = websocket.create_connection(url(server.port), timeout=5)
    raw.send("42[")
    while not isinstance(event := events.get(timeout=10), ProtocolErrorReported):
        pass
    assert "JSONDecodeError" in event.text
    raw.shutdown()


def test_two_unity_clients_are_told_apart(server, events):
    clients = [UnityClient("127.0.0.1", server.port) for _ in range(2)]
    for number, client in enumerate(clients):
        client.connect(timeout=5)
        client.send_telemetry({"number": str(number)})
        received = next_telemetry(events)
        assert received.wire == {"number": str(number)}
        server.send(received.client, "data", {"to": str(number)})
    for number, client in enumerate(clients):
        while not (event := client.receive(timeout=10)) or event.name != "data":
            assert event is not None
        assert event.data == {"to": str(number)}
        client.close()


@given(
    data=st.binary(max_size=70), mask=st.binary(min_size=4, max_size=4), offset=st.integers(0, 9)
)
def test_unmasking_is_the_librarys(data, mask, offset):
    expected = RFC6455WebSocket._apply_mask(data, tuple(mask), len(data), offset)
    assert apply_mask(data, tuple(mask), len(data), offset) == expected


def test_a_port_in_use_ends_the_node_with_one_sentence(server, domain_id):
    program = "from rover_bridge.node import main; main()"
    arguments = ["--ros-args", "-p", f"port:={server.port}", "-p", "host:=127.0.0.1"]
    ended = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", program, *arguments],
        env=os.environ | {"ROS_DOMAIN_ID": str(domain_id)},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert ended.returncode == CANNOT_START
    (line,) = ended.stderr.strip().splitlines()
    assert f"port {server.port} of 127.0.0.1 is in use" in line


def test_two_servers_do_not_share_a_port(events):
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    first = SocketServer("127.0.0.1", port, events.put)
    try:
        with pytest.raises(PortInUseError, match=str(port)):
            SocketServer("127.0.0.1", port, events.put)
    finally:
        first.close()
