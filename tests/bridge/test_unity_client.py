"""The simulator's side of the wire, byte for byte."""

import json
import select
import socket
from concurrent.futures import ThreadPoolExecutor

import pytest
from raw_server import Frame, RawServer
from telemetry import telemetry

from rover_simulator.wire.unity_client import (
    FRAGMENT_BYTES,
    ConnectionLostError,
    Event,
    ProtocolError,
    UnityClient,
)


@pytest.fixture
def wire():
    server = RawServer()
    client = UnityClient("127.0.0.1", server.port)
    with ThreadPoolExecutor(1) as pool:
        accepted = pool.submit(server.accept)
        client.connect(timeout=5)
        yield client, accepted.result()
    client.close()
    server.close()


def test_handshake(wire):
    _, server = wire
    first, *headers = server.request.strip().splitlines()
    assert first == "GET /socket.io/?EIO=4&transport=websocket HTTP/1.1"
    names = {header.split(":")[0].lower() for header in headers}
    assert not names & {"origin", "sec-websocket-protocol", "sec-websocket-extensions"}
    assert "Sec-WebSocket-Version: 13" in headers


def test_the_first_word_is_a_ping_and_never_a_connect(wire):
    _, server = wire
    assert server.frame() == Frame(True, 1, b"2")


def test_long_messages_go_in_fragments(wire):
    client, server = wire
    server.frame()
    client.send_telemetry(telemetry())
    frames = [server.frame()]
    while not frames[-1].final:
        frames.append(server.frame())
    assert len(frames) > 2
    assert [frame.opcode for frame in frames] == [1] + [0] * (len(frames) - 1)
    assert {len(frame.payload) for frame in frames[:-1]} == {FRAGMENT_BYTES}
    message = b"".join(frame.payload for frame in frames).decode()
    assert message.startswith('42["telemetry",{"steering_angle":"0.0000","throttle":"0.0000"')
    name, data = json.loads(message[2:])
    assert list(data) == list(telemetry())
    assert name == "telemetry"


def test_events_and_pings(wire):
    client, server = wire
    server.frame()
    for message in ('0{"sid":"x"}', "40", "3", "2", '42["data",{"throttle":"0"}]', '42["manual"]'):
        server.send(message)
    assert client.receive(5) == Event("open")
    assert client.receive(5) == Event("data", {"throttle": "0"})
    assert client.receive(5) == Event("manual")
    assert server.frame() == Frame(True, 1, b"3")
    assert client.receive(0.05) is None


@pytest.mark.parametrize(
    "bad",
    [
        "42[]",
        "42[5]",
        '42["data",5]',
        '42["data",["0"]]',
        '42["data","0"]',
        '42["data",null]',
        '42["a",{},{}]',
        "42nonsense",
        "42{}",
        "42" + 50_000 * "[",
        "0{}",  # the session's id is the one thing that must be there
        "0nonsense",
    ],
    ids=lambda bad: bad[:16],
)
def test_what_unity_cannot_parse_closes_the_socket(wire, bad):
    client, server = wire
    server.frame()
    server.send(bad)
    with pytest.raises(ProtocolError):
        client.receive(5)
    assert server.ended()


def test_a_compressed_frame_is_refused(wire):
    client, server = wire
    server.send('42["manual",{}]', first=0xC1)  # the bit RSV1
    with pytest.raises(ProtocolError):
        client.receive(5)
    assert server.ended()


def test_strings_are_taken_raw(wire):
    client, server = wire
    server.send(r'42["data",{"a":"\u0030","b":"x\"y","c":"\\","d":"\/"}]')
    expected = {"a": r"\u0030", "b": r"x\"y", "c": r"\\", "d": r"\/"}
    assert client.receive(5) == Event("data", expected)


def test_goodbye(wire):
    client, server = wire
    server.frame()
    server.send('42["manual",{}]')  # left unread, it must not cut the goodbye off
    client.close(graceful=True)
    assert [server.frame().payload for _ in range(2)] == [b"41", b"1"]
    assert server.frame().opcode == 0x8
    assert server.ended()


def test_a_look_without_waiting_finds_what_has_arrived(wire):
    client, server = wire
    assert client.receive(0) is None
    server.send('42["manual"]')
    assert select.select([client], [], [], 5)[0] == [client]
    assert client.receive(0) == Event("manual")


def test_a_frame_that_comes_in_two_parts_is_whole(wire):
    client, server = wire
    payload = b'42["data",{"throttle":"0"}]'
    server.socket.sendall(bytes([0x81, len(payload)]) + payload[:7])
    assert client.receive(0.01) is None
    server.socket.sendall(payload[7:])
    assert client.receive(5) == Event("data", {"throttle": "0"})


def test_a_websocket_ping_is_answered(wire):
    client, server = wire
    server.frame()
    server.socket.sendall(bytes([0x89, 2]) + b"hi")
    assert client.receive(0.05) is None
    assert server.frame() == Frame(True, 0xA, b"hi")


def test_the_next_ping_comes_a_period_after_the_pong(wire, monkeypatch):
    client, server = wire
    monkeypatch.setattr("rover_simulator.wire.unity_client.PING_PERIOD", 0.0)
    assert server.frame() == Frame(True, 1, b"2")
    server.send("3")
    assert client.receive(0.05) is None
    assert server.frame() == Frame(True, 1, b"2")


def test_an_answer_that_is_no_websocket_is_a_lost_connection():
    with socket.create_server(("127.0.0.1", 0)) as listener, ThreadPoolExecutor(1) as pool:
        client = UnityClient("127.0.0.1", listener.getsockname()[1])
        done = pool.submit(client.connect, 5)
        connection, _ = listener.accept()
        with connection:
            connection.sendall(b"nonsense\r\n\r\n")
        with pytest.raises(ConnectionLostError):
            done.result()


def test_it_tries_until_a_server_is_there():
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    client = UnityClient("127.0.0.1", port)
    with pytest.raises(ConnectionLostError):
        client.connect(timeout=1)
    tries = iter([False, False, False, True])
    assert not client.connect_until(lambda: next(tries))
