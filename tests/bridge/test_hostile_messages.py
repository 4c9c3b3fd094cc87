"""Messages that are no packet, or too much: what becomes of the client that sends them."""

from __future__ import annotations

import pytest
import websocket
from answering_server import WAIT, answers, closing, event, read_all
from flooders import frame, open_websocket

from rover_bridge.transport import Disconnected, ProtocolErrorReported, TelemetryReceived
from rover_bridge.wire_format import MAX_MESSAGE_BYTES


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
