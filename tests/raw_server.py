"""A WebSocket server by hand, for tests that look at the bytes of the simulator's side."""

from __future__ import annotations

import json
import socket
import struct
from base64 import b64encode
from dataclasses import dataclass
from hashlib import sha1
from typing import Any

GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
WAIT = 10.0  # [s] what a read waits at most
HANDSHAKE = '0{"sid":"x","upgrades":[],"pingTimeout":60000,"pingInterval":25000}'
PING, PONG = "2", "3"


@dataclass(frozen=True)
class Frame:
    final: bool
    opcode: int
    payload: bytes


class Wire:
    """One accepted connection, after its HTTP handshake."""

    def __init__(self, connection: socket.socket) -> None:
        self.socket = connection
        connection.settimeout(WAIT)
        data = b""
        while not data.endswith(b"\r\n\r\n"):
            data += self._read(1)
        self.request = data.decode()
        key = next(
            line.split(": ")[1] for line in self.request.splitlines() if "WebSocket-Key" in line
        )
        accept = b64encode(sha1((key + GUID).encode()).digest()).decode()
        connection.sendall(
            b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            + f"Sec-WebSocket-Accept: {accept}\r\n\r\n".encode()
        )

    def frame(self) -> Frame:
        """The next frame; asserts that it is masked. ConnectionError at the end."""
        first, second = self._read(2)
        assert second & 0x80, "the simulator masks every frame"
        length = second & 0x7F
        if length == 126:
            (length,) = struct.unpack("!H", self._read(2))
        assert length < 65536
        mask = self._read(4)
        payload = bytes(b ^ mask[i % 4] for i, b in enumerate(self._read(length)))
        return Frame(bool(first & 0x80), first & 0x0F, payload)

    def message(self) -> str:
        """The next message, of however many frames."""
        frames = [self.frame()]
        while not frames[-1].final:
            frames.append(self.frame())
        return b"".join(frame.payload for frame in frames).decode()

    def telemetry(self) -> dict[str, Any]:
        """The next telemetry; pings on the way are answered."""
        while (message := self.message()) == PING:
            self.send(PONG)
        name, data = json.loads(message.removeprefix("42"))
        assert name == "telemetry"
        return data

    def send(self, text: str, first: int = 0x81) -> None:
        """A text message in one frame; `first` is the frame's first byte."""
        payload = text.encode()
        length = len(payload)
        header = bytes([first, length]) if length < 126 else struct.pack("!BBH", first, 126, length)
        self.socket.sendall(header + payload)

    def emit(self, name: str, data: Any = None) -> None:
        """A Socket.IO event."""
        members = [name] if data is None else [name, data]
        self.send("42" + json.dumps(members, separators=(",", ":")))

    def ended(self) -> bool:
        """Reads what is left; True when the other side has closed, False when it is silent."""
        try:
            while self.socket.recv(4096):
                pass
        except TimeoutError:
            return False
        except ConnectionError:
            pass
        return True

    def close(self) -> None:
        self.socket.close()

    def _read(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise ConnectionError("the simulator has closed the socket")
            data += part
        return data


class RawServer:
    """Listens on a free port of loopback, or on the one given."""

    def __init__(self, port: int = 0) -> None:
        self._listener = socket.create_server(("127.0.0.1", port))
        self.port = int(self._listener.getsockname()[1])
        self._wires: list[Wire] = []

    def accept(self, timeout: float = WAIT) -> Wire:
        """The next connection, within `timeout` [s]."""
        self._listener.settimeout(timeout)
        wire = Wire(self._listener.accept()[0])
        self._wires.append(wire)
        return wire

    def close(self) -> None:
        self._listener.close()
        for wire in self._wires:
            wire.close()
