"""The simulator's side of the wire, byte for byte."""

import json
import select
import socket
import struct
import threading
from base64 import b64encode
from hashlib import sha1

import pytest
from telemetry import telemetry

from rover_simulator.unity_client import (
    FRAGMENT_BYTES,
    ConnectionLostError,
    Event,
    ProtocolError,
    UnityClient,
)

GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"


class RawServer:
    """Accepts one WebSocket by hand and keeps the bytes that came."""

    def __init__(self) -> None:
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self.request = ""
        self._thread = threading.Thread(target=self._accept)
        self._thread.start()

    def _accept(self) -> None:
        self.connection, _ = self._listener.accept()
        self.connection.settimeout(5)
        data = b""
        while not data.endswith(b"\r\n\r\n"):
            data += self.connection.recv(1)
        self.request = data.decode()
        key = next(
            line.split(": ")[1] for line in self.request.splitlines() if "WebSocket-Key" in line
        )
        accept = b64encode(sha1((key + GUID).encode()).digest()).decode()
        self.connection.sendall(
            b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            + f"Sec-WebSocket-Accept: {accept}\r\n\r\n".encode()
        )

    def frame(self) -> tuple[bool, int, bytes]:
        """(final, opcode, payload) of the next frame; asserts that it is masked."""
        first, second = self._read(2)
        assert second & 0x80, "the simulator masks every frame"
        length = second & 0x7F
        if length == 126:
            (length,) = struct.unpack("!H", self._read(2))
        assert length < 65536
        mask = self._read(4)
        payload = bytes(b ^ mask[i % 4] for i, b in enumerate(self._read(length)))
        return bool(first & 0x80), first & 0x0F, payload

    def send(self, text: str) -> None:
        payload = text.encode()
        assert len(payload) < 126
        self.connection.sendall(bytes([0x81, len(payload)]) + payload)

    def _read(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            data += self.connection.recv(count - len(data))
        return data

    def close(self) -> None:
        self._thread.join()
        self.connection.close()
        self._listener.close()


@pytest.fixture
def wire():
    server = RawServer()
    client = UnityClient("127.0.0.1", server.port)
    client.connect(timeout=5)
    yield client, server
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
    assert server.frame() == (True, 1, b"2")


def test_long_messages_go_in_fragments(wire):
    client, server = wire
    server.frame()
    client.send_telemetry(telemetry())
    frames = [server.frame()]
    while not frames[-1][0]:
        frames.append(server.frame())
    assert len(frames) > 2
    assert [opcode for _, opcode, _ in frames] == [1] + [0] * (len(frames) - 1)
    assert {len(payload) for _, _, payload in frames[:-1]} == {FRAGMENT_BYTES}
    message = b"".join(payload for _, _, payload in frames).decode()
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
    assert server.frame() == (True, 1, b"3")
    assert client.receive(0.05) is None


@pytest.mark.parametrize("bad", ["42[]", '42["data",5]', '42["a",{},{}]', "42nonsense", "42{}"])
def test_what_unity_cannot_parse_closes_the_socket(wire, bad):
    client, server = wire
    server.frame()
    server.send(bad)
    with pytest.raises(ProtocolError):
        client.receive(5)


def test_goodbye(wire):
    client, server = wire
    server.frame()
    client.close(say_goodbye=True)
    assert server.frame()[2] == b"41"
    assert server.frame()[2] == b"1"


def test_a_look_without_waiting_finds_what_has_arrived(wire):
    client, server = wire
    assert client.receive(0) is None
    server.send('42["manual"]')
    assert select.select([client], [], [], 5)[0] == [client]
    assert client.receive(0) == Event("manual")


def test_a_frame_that_comes_in_two_parts_is_whole(wire):
    client, server = wire
    payload = b'42["data",{"throttle":"0"}]'
    server.connection.sendall(bytes([0x81, len(payload)]) + payload[:7])
    assert client.receive(0.01) is None
    server.connection.sendall(payload[7:])
    assert client.receive(5) == Event("data", {"throttle": "0"})


def test_a_websocket_ping_is_answered(wire):
    client, server = wire
    server.frame()
    server.connection.sendall(bytes([0x89, 2]) + b"hi")
    assert client.receive(0.05) is None
    assert server.frame() == (True, 0xA, b"hi")


def test_the_next_ping_comes_a_period_after_the_pong(wire, monkeypatch):
    client, server = wire
    monkeypatch.setattr("rover_simulator.unity_client.PING_PERIOD", 0.0)
    assert server.frame() == (True, 1, b"2")
    server.send("3")
    assert client.receive(0.05) is None
    assert server.frame() == (True, 1, b"2")


def test_it_tries_until_a_server_is_there():
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    client = UnityClient("127.0.0.1", port)
    with pytest.raises(ConnectionLostError):
        client.connect(timeout=1)
    tries = iter([False, False, False, True])
    assert not client.connect_until(lambda: next(tries))
