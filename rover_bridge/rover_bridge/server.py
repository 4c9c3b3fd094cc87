"""The Socket.IO server: eventlet in a thread of its own, without monkey-patching."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import eventlet
import eventlet.wsgi
import socketio
from eventlet.hubs import trampoline

from rover_bridge.legacy_engineio import DualProtocolServer, accept_legacy_queries
from rover_common.errors import RoverError

MAX_MESSAGE_BYTES = 16 * 2**20  # a telemetry has about 10 kB; the library's default is 1 MB
PING_TIMEOUT = 60.0  # [s] sent to the simulator, which ignores it
STOP_SECONDS = 5.0  # [s] until the thread has ended


class PortInUseError(RoverError, OSError):
    """Another program listens on the port."""


@dataclass(frozen=True)
class Connected:
    """A client has joined the default namespace."""

    client: str


@dataclass(frozen=True)
class Disconnected:
    """A client has left, or its connection has ended."""

    client: str


@dataclass(frozen=True)
class TelemetryReceived:
    """A client sent the event `telemetry`."""

    client: str
    wire: object  # as it came: usually the telemetry object


@dataclass(frozen=True)
class ProtocolErrorReported:
    """A client sent a message that is no packet of either protocol; its connection has ended."""

    text: str


ServerEvent = Connected | Disconnected | TelemetryReceived | ProtocolErrorReported


class _ErrorLog(logging.Handler):
    """Makes an event of each error that the libraries log."""

    def __init__(self, on_event: Callable[[ServerEvent], None]) -> None:
        super().__init__(logging.ERROR)
        self._on_event = on_event

    def emit(self, record: logging.LogRecord) -> None:
        cause = f": {record.exc_info[1]!r}" if record.exc_info else ""
        self._on_event(ProtocolErrorReported((record.getMessage() + cause)[:200]))


class SocketServer:
    """Hands over what arrives by `on_event`, called in the server's thread; it must not block."""

    def __init__(self, host: str, port: int, on_event: Callable[[ServerEvent], None]) -> None:
        """Listens when it returns; raises PortInUseError or OSError."""
        self._on_event = on_event
        self._outbox: deque[tuple[str, str, dict[str, Any]] | None] = deque()
        self._wake_read, self._wake_write = os.pipe()
        os.set_blocking(self._wake_read, False)
        self._started: deque[int | OSError] = deque()
        ready = threading.Event()
        self._thread = threading.Thread(
            target=self._run, args=(host, port, ready), name="socket-server", daemon=True
        )
        self._thread.start()
        ready.wait()
        outcome = self._started[0]
        if isinstance(outcome, OSError):
            self._join()
            if outcome.errno == errno.EADDRINUSE:
                raise PortInUseError(
                    f"port {port} of {host} is in use: end the other program, or choose a port"
                ) from outcome
            raise outcome
        self.port = outcome

    def send(self, client: str, event: str, data: dict[str, Any]) -> None:
        """Send an event to a client, from any thread; a client that has left is ignored."""
        self._outbox.append((client, event, data))
        os.write(self._wake_write, b"x")

    def close(self) -> None:
        """Close all connections and end the thread."""
        self._outbox.append(None)
        os.write(self._wake_write, b"x")
        self._join()

    def _join(self) -> None:
        self._thread.join(STOP_SECONDS)
        if not self._thread.is_alive():  # else, on a busy machine, it still waits at the pipe
            os.close(self._wake_read)
            os.close(self._wake_write)

    def _run(self, host: str, port: int, ready: threading.Event) -> None:
        # The default hub keeps an epoll object open beyond the end of its thread.
        eventlet.hubs.use_hub("poll")
        try:
            listener = eventlet.listen((host, port), reuse_port=False)  # one bridge per port
        except OSError as error:
            self._started.append(error)
            ready.set()
            return
        server = self._socketio_server()
        app = accept_legacy_queries(socketio.WSGIApp(server))
        quiet = logging.Logger("wsgi", logging.CRITICAL)
        pool = eventlet.GreenPool(100)
        acceptor = eventlet.spawn(
            eventlet.wsgi.server, listener, app, log=quiet, log_output=False, custom_pool=pool
        )
        self._started.append(listener.getsockname()[1])
        ready.set()
        self._pump(server)
        acceptor.kill()
        for worker in list(pool.coroutines_running):
            worker.kill()
        with contextlib.suppress(OSError):
            listener.close()

    def _socketio_server(self) -> DualProtocolServer:
        log = logging.Logger("socketio", logging.ERROR)
        log.addHandler(_ErrorLog(self._on_event))
        server = DualProtocolServer(
            logger=log,
            engineio_logger=log,
            async_mode="eventlet",
            async_handlers=False,  # keeps the events of one client in order
            max_http_buffer_size=MAX_MESSAGE_BYTES,
            ping_timeout=PING_TIMEOUT,
            monitor_clients=False,  # a connection's own timeout does that
            cors_allowed_origins="*",
        )
        server.on("connect", lambda client, *_: self._on_event(Connected(client)))
        server.on("disconnect", lambda client, *_: self._on_event(Disconnected(client)))
        server.on("telemetry", self._on_telemetry)
        return server

    def _on_telemetry(self, client: str, *arguments: object) -> None:
        wire = arguments[0] if len(arguments) == 1 else arguments
        self._on_event(TelemetryReceived(client, wire))

    def _pump(self, server: DualProtocolServer) -> None:
        """Send what other threads put into the outbox, until the server is closed."""
        while True:
            trampoline(self._wake_read, read=True)
            with contextlib.suppress(BlockingIOError):
                os.read(self._wake_read, 4096)
            while self._outbox:
                item = self._outbox.popleft()
                if item is None:
                    return
                client, event, data = item
                server.emit(event, data, to=client)
