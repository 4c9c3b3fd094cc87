"""Connect to a rover server exactly as the Unity simulator does.

The query says Engine.IO 4, but the packets are those of Engine.IO 3: the client sends the pings and
no Socket.IO connect packet. It splits long messages into WebSocket continuation frames.
"""

from __future__ import annotations

import contextlib
import json
import math
import re
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import websocket

from rover_common.errors import RoverError

FRAGMENT_BYTES = 1016
PING_PERIOD = 25.0  # [s] after each pong
RECONNECT_PAUSE = 0.005  # [s]
CONNECT_TIMEOUT, SEND_TIMEOUT = 5.0, 5.0  # [s]
CLOSE_TIMEOUT = 0.5  # [s] for the server's side of the closing handshake
SILENCE = 5.0  # [s] without an answer to a telemetry until it is told
SHORTEST_WAIT = 0.001  # [s]

# Each of these events is answered with exactly one telemetry.
ANSWERED_EVENTS = frozenset({"data", "manual", "pickup", "fixed_turn"})
ESCAPE = re.compile(r"\\([\"\\]?)")
OPEN = "open"  # the server's handshake packet; the simulator sends a telemetry on it, unasked


class ProtocolError(RoverError):
    """The server sent what the simulator cannot take; the simulator closes the socket then."""


class ConnectionLostError(RoverError, ConnectionError):
    """The connection was refused, or ended."""


@dataclass(frozen=True)
class Event:
    """`open`, or a Socket.IO event of the server."""

    name: str
    data: Mapping[str, Any] = field(default_factory=dict)


class UnityClient:
    """One connection; no thread of its own, so `receive` has to be called for pings to be sent."""

    def __init__(
        self, host: str, port: int, tell: Callable[[str], None] = lambda text: None
    ) -> None:
        """tell: what is wrong with the server's answers, once each time."""
        self.address = f"{host}:{port}"
        self.refused = ""  # why the server refused what was sent last; empty when it did not
        self._tell = tell
        self._url = f"ws://{host}:{port}/socket.io/?EIO=4&transport=websocket"
        self._socket: websocket.WebSocket | None = None
        self._next_ping: float | None = None
        self._asked: float | None = None  # [s] since when an answer is waited for

    def connect(self, timeout: float) -> None:
        """Open the socket and send the first ping; raises ConnectionLostError."""
        socket = websocket.WebSocket(skip_utf8_validation=True)
        socket.settimeout(timeout)
        try:
            socket.connect(self._url, suppress_origin=True)
        except websocket.WebSocketBadStatusException as error:
            body = (error.resp_body or b"").decode(errors="replace").strip()
            self._note_refusal(f"status {error.status_code}: {body}")
            raise ConnectionLostError(f"{self._url}: {self.refused}") from error
        except (OSError, websocket.WebSocketException, ValueError, IndexError) as error:
            # The last two are the library's, for an answer that is no HTTP.
            self.refused = ""
            raise ConnectionLostError(f"{self._url}: {error}") from error
        self._socket = socket
        self._send("2")
        self._next_ping = self._asked = None

    def connect_until(
        self, stopped: Callable[[], bool], while_waiting: Callable[[], None] = lambda: None
    ) -> bool:
        """Try until it succeeds, as the simulator does; False when `stopped` came first.

        `while_waiting` is called between two attempts.
        """
        while not stopped():
            try:
                self.connect(timeout=CONNECT_TIMEOUT)
            except ConnectionLostError:
                self.close()
                while_waiting()
                time.sleep(RECONNECT_PAUSE)
            else:
                return True
        return False

    def send_telemetry(self, telemetry: Mapping[str, str]) -> None:
        """Raises ConnectionLostError."""
        arguments = json.dumps(["telemetry", telemetry], separators=(",", ":"))
        self._send("42" + arguments)
        if self._asked is None:
            self._asked = time.monotonic()

    def receive(self, timeout: float) -> Event | None:
        """The next event, or None after `timeout` [s]; 0 takes only what has already arrived.

        Answers and sends pings meanwhile. Raises ConnectionLostError, and ProtocolError after
        closing the socket.
        """
        end = time.monotonic() + timeout
        while True:
            self._ping_when_due()
            message = self._receive_text(max(0.0, end - time.monotonic()))
            event = None if message is None else self._event(message)
            if event is not None:
                self._asked = time.monotonic() if event.name == OPEN else None
                return event
            self._note_silence()
            if message is None and time.monotonic() >= end:
                return None

    def fileno(self) -> int:
        """The socket's file descriptor, readable when `receive` has something to read."""
        raw_socket = self._connected().sock
        assert raw_socket is not None
        return int(raw_socket.fileno())

    def close(self, graceful: bool = False) -> None:
        """Close the socket; `graceful` sends first what the application sends when it is quit."""
        if self._socket is None:
            return
        if graceful:
            with contextlib.suppress(ConnectionLostError):
                self._send("41")
                self._send("1")
            # Ends only after the server has: unread data would reset the connection before.
            self._socket.close(timeout=CLOSE_TIMEOUT)
        self._socket.shutdown()
        self._socket = None

    def _event(self, message: str) -> Event | None:
        """The event of a message; None for messages that are no event."""
        if message.startswith("42"):
            return self._parse_event(message[2:])
        if message.startswith("0"):
            return self._parse_open(message[1:])
        if message.startswith("2"):
            self._send("3")
        elif message.startswith("3"):
            self._next_ping = time.monotonic() + PING_PERIOD
        return None  # as for 40, the acknowledgement of a connect packet

    def _parse_open(self, text: str) -> Event:
        handshake = _parse_json(text)
        if isinstance(handshake, dict) and "sid" in handshake:
            return Event(OPEN)
        raise self._refusal(f"an open packet without sid: {text[:80]}")

    def _parse_event(self, text: str) -> Event:
        members = _parse_json(text)
        if isinstance(members, list) and len(members) in (1, 2) and isinstance(members[0], str):
            data = members[1] if len(members) == 2 else {}
            if isinstance(data, dict):
                self._note_refusal(str(data.get("refused", "")))
                return Event(members[0], data)
        raise self._refusal(f"not an event with one object: {text[:80]}")

    def _note_refusal(self, reason: str) -> None:
        if reason and reason != self.refused:
            self._tell(f"refused by the server: {reason}")
        self.refused = reason

    def _note_silence(self) -> None:
        if self._asked is not None and time.monotonic() - self._asked > SILENCE:
            self._asked = math.inf  # told until it answers
            self._tell(f"connected to {self.address}, which does not answer")

    def _refusal(self, reason: str) -> ProtocolError:
        """Closes the socket, as an exception in the original's receiver does."""
        self.close()
        return ProtocolError(reason)

    def _receive_text(self, timeout: float) -> str | None:
        socket = self._connected()
        # Wakes up for a ping that is due; 0 would mean a socket that raises instead of waiting.
        socket.settimeout(min(max(timeout, SHORTEST_WAIT), 1.0))
        try:
            opcode, data = socket.recv_data()
        except websocket.WebSocketTimeoutException:
            return None
        except websocket.WebSocketProtocolException as error:  # also a compressed frame
            raise self._refusal(str(error)) from error
        except (OSError, websocket.WebSocketException) as error:
            raise ConnectionLostError(str(error)) from error
        if opcode == websocket.ABNF.OPCODE_CLOSE:
            raise ConnectionLostError("closed by the server")
        return bytes(data).decode("utf-8", errors="replace")

    def _ping_when_due(self) -> None:
        if self._next_ping is not None and time.monotonic() >= self._next_ping:
            self._next_ping = None
            self._send("2")

    def _send(self, text: str) -> None:
        payload = text.encode("ascii")
        fragments = [
            payload[start : start + FRAGMENT_BYTES]
            for start in range(0, len(payload), FRAGMENT_BYTES)
        ]
        last = len(fragments) - 1
        frames = b"".join(
            websocket.ABNF(
                int(index == last),
                opcode=websocket.ABNF.OPCODE_CONT if index else websocket.ABNF.OPCODE_TEXT,
                data=fragment,
            ).format()
            for index, fragment in enumerate(fragments)
        )
        raw_socket = self._connected().sock
        assert raw_socket is not None
        raw_socket.settimeout(SEND_TIMEOUT)
        try:
            raw_socket.sendall(frames)
        except OSError as error:
            raise ConnectionLostError(str(error)) from error

    def _connected(self) -> websocket.WebSocket:
        if self._socket is None:
            raise ConnectionLostError("not connected")
        return self._socket


def _parse_json(text: str) -> Any:
    """The value of a JSON text with its strings raw, as the simulator reads them: the escapes in
    them stay escapes. None for what is no JSON."""
    try:
        return json.loads(ESCAPE.sub(_escape_again, text))
    except (ValueError, RecursionError):
        return None


def _escape_again(escape: re.Match[str]) -> str:
    quoted = escape[1]
    return r"\\" + (f"\\{quoted}" if quoted else "")
