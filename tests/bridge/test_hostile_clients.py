"""The socket server beside clients that harm: it serves the others, and tells why it refuses."""

from __future__ import annotations

import json
import socket
import time

import pytest
from answering_server import WAIT, answers, closing, event, read_all
from flooders import HANDSHAKE, frame, open_websocket, running

from rover_bridge import connections, flow_control
from rover_bridge.flow_control import BURST, MAX_OWED
from rover_bridge.transport import (
    Connected,
    ConnectionRefused,
    Disconnected,
    TelemetryReceived,
)


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
