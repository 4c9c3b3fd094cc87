"""The WebSocket of python-engineio for eventlet, with bounds, and unmasked by numpy.

The library unmasks byte by byte in Python, which costs milliseconds for a message of 10 kB. It
waits for a message for ever, and bounds a frame but not a message of many.
"""

from __future__ import annotations

import io
import time
from collections.abc import Callable, Sequence
from typing import Any

import eventlet
import numpy as np
from engineio.async_drivers.eventlet import WebSocketWSGI
from eventlet.websocket import FailedConnectionError, RFC6455WebSocket

from rover_bridge.rate_limit import TokenBucket
from rover_bridge.transport import WireLimits
from rover_bridge.wire_format import MAX_MESSAGE_BYTES, WireError, check_packet

GOING_AWAY, POLICY_VIOLATION, TOO_BIG = 1001, 1008, 1009  # WebSocket status
BYTES_PER_MESSAGE = 32 * 1024  # of the bytes that a client may send, at its rate of messages
FRAME_COST = 2048  # [B] that a frame counts for beyond its own
FRAMES_PER_TURN = 16  # of one client, before the others have their turns


def apply_mask(
    data: bytes, mask: Sequence[int], length: int | None = None, offset: int = 0
) -> bytes:
    """XOR with the four bytes of the mask, repeated, beginning at `offset` (RFC 6455, 5.3)."""
    payload = np.frombuffer(data, np.uint8, count=len(data) if length is None else length)
    key = np.roll(np.array(mask, np.uint8), -(offset % 4))
    return (payload ^ np.resize(key, payload.size)).tobytes()


class WireWebSocket(RFC6455WebSocket):
    """Reads text messages of bounded size at a bounded rate, and ends when none comes."""

    _apply_mask = staticmethod(apply_mask)

    def __init__(
        self,
        sock: Any,
        environ: dict[str, Any],
        limits: WireLimits,
        on_error: Callable[[str], None],
    ) -> None:
        """on_error: told of messages that are no packet."""
        super().__init__(sock, environ, max_frame_length=MAX_MESSAGE_BYTES)
        self.log = io.StringIO()  # it reports that it closes twice
        self._idle_limit = limits.idle_limit
        self._on_error = on_error
        self._bytes = TokenBucket(limits.client_rate * BYTES_PER_MESSAGE, 2.0 * MAX_MESSAGE_BYTES)
        self._size = 0  # [B] of the message so far
        self._frames = 0

    def wait(self) -> str | None:
        """The next message; None when the connection has ended.

        Raises WireError, after closing, for what is no packet, or when none came in time.
        """
        self.socket.settimeout(self._idle_limit + 1.0)  # for what is sent; the deadline is earlier
        deadline = eventlet.Timeout(self._idle_limit)
        try:
            message = super().wait()
        except eventlet.Timeout as timeout:
            if timeout is not deadline:
                raise
            raise self._closed(GOING_AWAY, f"no message in {self._idle_limit:g} s") from None
        finally:
            deadline.cancel()
        if message is None:
            return None
        try:
            check_packet(message)
        except WireError as error:
            self._on_error(f"no packet: {error}")
            raise self._closed(POLICY_VIOLATION, str(error)) from None
        return str(message)

    def _closed(self, status: int, reason: str) -> WireError:
        self.close(close_data=(status, reason.encode()[:123].decode(errors="ignore")))
        return WireError(reason)

    def _recv_frame(self, message: Any = None) -> Any:
        before = 0 if message is None else len(message.data)
        frame = super()._recv_frame(message)
        parts = frame.data[before:] if frame is message else frame.data
        size = sum(map(len, parts))
        self._frames += 1
        delay = self._bytes.take(time.monotonic(), size + FRAME_COST)
        if delay > 0.0 or self._frames % FRAMES_PER_TURN == 0:
            eventlet.sleep(delay)
        if not frame.opcode & 8:  # no control frame
            self._size = size + (self._size if frame is message else 0)
            if self._size > MAX_MESSAGE_BYTES:
                raise FailedConnectionError(TOO_BIG, f"a message of {self._size} bytes")
        return frame


class WireWebSocketWSGI(WebSocketWSGI):
    """Opens such WebSockets, for an Engine.IO server that has `limits` and `connections`."""

    def __init__(self, handler: Any, server: Any) -> None:
        super().__init__(handler, server)
        self.support_legacy_versions = False  # handshakes from before RFC 6455
        self._limits = server.limits
        self._connections = server.connections
        self._on_error = server.logger.error

    def _handle_hybi_request(self, environ: dict[str, Any]) -> WireWebSocket:
        opened = super()._handle_hybi_request(environ)
        connection = self._connections.of(environ)
        if connection is not None:
            connection.is_websocket = True
        return WireWebSocket(opened.socket, environ, self._limits, self._on_error)
