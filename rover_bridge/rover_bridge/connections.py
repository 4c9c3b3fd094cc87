"""The open connections: how many there may be, and which one makes room for another.

It is the pool of eventlet's HTTP server, whose own pool would make every new connection wait until
one of the others has ended.
"""

from __future__ import annotations

import contextlib
import select
import socket
import struct
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import eventlet
from eventlet import greenio, wsgi

from rover_bridge.rate_limit import TokenBucket

ACCEPT_RATE = 200.0  # [1/s] connections that are accepted
HEADER_SECONDS = 5.0  # [s] in which a request's line and headers have to arrive
REFUSAL_SECONDS = 0.5  # [s] in which a client that is refused may read why
MAX_REFUSALS = 32  # that wait for this at a time; more are closed at once
TRY_AGAIN = 1013  # WebSocket status
CLOSE_FRAME = 0x88
GONE = getattr(select, "POLLRDHUP", 0)  # of Linux; errors are reported anyway


@dataclass
class Connection:
    """One open connection."""

    socket: Any
    address: str
    heard: float = field(default_factory=time.monotonic)  # [s] of its latest message
    is_websocket: bool = False
    sent_telemetry: bool = False

    def gone(self) -> bool:
        """Whether the other end has closed it, however much there is to read."""
        poll = select.poll()
        poll.register(self.socket.fileno(), GONE)
        return bool(poll.poll(0))

    def close(self, status: str, reason: str) -> None:
        """Tell why, if its buffer has room, and end it."""
        with contextlib.suppress(OSError):
            raw = self.socket.fd  # never blocks
            raw.send(close_frame(reason) if self.is_websocket else http_refusal(status, reason))
        greenio.shutdown_safe(self.socket)


class Connections:
    """Spawns what serves a connection; called by eventlet.wsgi in the server's thread."""

    def __init__(self, limit: int, on_refused: Callable[[str, str], None]) -> None:
        """limit: connections open at a time; on_refused: address and reason."""
        self._limit = limit
        self._on_refused = on_refused
        self._open: dict[str, Connection] = {}
        self._threads: set[Any] = set()
        self._refusals = eventlet.GreenPool(MAX_REFUSALS)
        self._accepts = TokenBucket(ACCEPT_RATE, ACCEPT_RATE)

    def of(self, environ: dict[str, Any]) -> Connection | None:
        """The connection of a request."""
        return self._open.get(f"{environ['REMOTE_ADDR']} {environ['REMOTE_PORT']}")

    def spawn(self, serve: Callable[..., None], state: list[Any]) -> Any:
        """Serve a connection that was accepted, or refuse it."""
        eventlet.sleep(self._accepts.take(time.monotonic()))  # the others have their turns first
        (host, port), raw = state[0][:2], state[1]
        if len(self._open) >= self._limit and not self._make_room():
            reason = f"too many connections: {self._limit} are open"
            self._on_refused(host, reason)
            if self._refusals.free() <= 0:
                return eventlet.spawn(lambda: None)
            return self._refusals.spawn(_refuse, raw, reason)
        key = f"{host} {port}"
        self._open[key] = connection = Connection(raw, host)
        thread = eventlet.spawn(serve, state)
        self._threads.add(thread)
        thread.link(self._forget, key, connection)
        return thread

    def waitall(self) -> None:
        """Nothing: at its end the server kills them."""

    def kill_all(self) -> None:
        """End all connections."""
        for thread in [*self._threads, *self._refusals.coroutines_running]:
            thread.kill()

    def _forget(self, thread: Any, key: str, connection: Connection) -> None:
        self._threads.discard(thread)
        if self._open.get(key) is connection:  # else it made room, and its port is in use again
            del self._open[key]

    def _make_room(self) -> bool:
        """End the connection without a telemetry that was silent for longest; False for none."""
        silent = {key: c for key, c in self._open.items() if not c.sent_telemetry}
        if not silent:
            return False
        key = min(silent, key=lambda key: silent[key].heard)
        reason = "too many connections: this one was silent for longest"
        self._on_refused(silent[key].address, reason)
        silent[key].close("503 Service Unavailable", reason)
        self._open.pop(key)
        return True


def http_refusal(status: str, reason: str) -> bytes:
    """A whole answer that says why; the connection closes after it."""
    body = reason.encode() + b"\n"
    head = f"HTTP/1.1 {status}\r\nContent-Type: text/plain\r\nContent-Length: {len(body)}\r\n"
    return head.encode() + b"Connection: close\r\n\r\n" + body


def close_frame(reason: str, status: int = TRY_AGAIN) -> bytes:
    """The closing frame of a server's WebSocket (RFC 6455, 5.5.1)."""
    payload = struct.pack("!H", status) + reason.encode()[:123]
    return bytes([CLOSE_FRAME, len(payload)]) + payload


def _refuse(raw: Any, reason: str) -> None:
    """A client reads nothing more once it is reset, so its request is read before the end."""
    with contextlib.suppress(OSError):
        raw.settimeout(REFUSAL_SECONDS)
        raw.sendall(http_refusal("503 Service Unavailable", reason))
        raw.shutdown(socket.SHUT_WR)
        with eventlet.Timeout(REFUSAL_SECONDS, False):
            while raw.recv(4096):
                pass


class DeadlineHttpProtocol(wsgi.HttpProtocol):
    """Gives a request's headers a time in which to arrive, whole and not byte by byte."""

    _deadline: Any = None

    def handle_one_request(self) -> None:
        """Also the wait for a further request on the same connection ends with the deadline."""
        self._deadline = eventlet.Timeout(HEADER_SECONDS)
        try:
            super().handle_one_request()
        except eventlet.Timeout as timeout:
            if timeout is not self._deadline:
                raise
            self.close_connection = True
            refusal = http_refusal("408 Request Timeout", "the request's headers are not whole")
            with contextlib.suppress(OSError):
                self.connection.fd.send(refusal)
        finally:
            self._deadline.cancel()

    def get_environ(self) -> dict[str, Any]:
        """Called as soon as the headers are there."""
        self._deadline.cancel()
        environ: dict[str, Any] = super().get_environ()
        return environ
