"""The Socket.IO transport: eventlet in a thread of its own, without monkey-patching."""

from __future__ import annotations

import contextlib
import errno
import logging
import os
import socket
import threading
import time
from collections import deque
from typing import Any

import eventlet
import eventlet.wsgi
import socketio
from eventlet.hubs import trampoline

from rover_bridge.access import Access
from rover_bridge.connections import Connections, DeadlineHttpProtocol
from rover_bridge.flow_control import ClientGoneError
from rover_bridge.gate import Gate
from rover_bridge.legacy_engineio import TELEMETRY, DualProtocolServer, accept_legacy_queries
from rover_bridge.transport import (
    Connected,
    ConnectionRefused,
    Disconnected,
    ListenError,
    OnEvent,
    PortInUseError,
    ProtocolErrorReported,
    TelemetryReceived,
    WireLimits,
)
from rover_bridge.wire_format import MAX_MESSAGE_BYTES

PING_TIMEOUT = 60.0  # [s] sent to the simulator, which ignores it
HTTP_TIMEOUT = 10.0  # [s] of one read or write of a request
SWEEP_SECONDS = 1.0  # [s] between two looks for silent sessions
STOP_SECONDS = 5.0  # [s] until the thread has ended


class _ErrorLog(logging.Handler):
    """Makes an event of each error that the libraries log."""

    def __init__(self, on_event: OnEvent) -> None:
        super().__init__(logging.ERROR)
        self._on_event = on_event

    def emit(self, record: logging.LogRecord) -> None:
        if record.exc_info and isinstance(record.exc_info[1], ClientGoneError):
            return  # it ends in any case
        cause = f": {record.exc_info[1]!r}" if record.exc_info else ""
        self._on_event(ProtocolErrorReported((record.getMessage() + cause)[:200]))


class SocketServer:
    """A `Transport`; hands over what arrives by `on_event`, called in the server's thread."""

    def __init__(
        self,
        host: str,
        port: int,
        on_event: OnEvent,
        limits: WireLimits | None = None,
        access: Access | None = None,
    ) -> None:
        """Listens when it returns; raises PortInUseError or ListenError."""
        listener = _listen(host, port)
        self.port: int = listener.getsockname()[1]
        self._on_event = on_event
        self._limits = limits or WireLimits()
        self._access = access or Access()
        self._outbox: deque[tuple[str, str, dict[str, Any]] | None] = deque()
        self._wake_read, self._wake_write = os.pipe()
        os.set_blocking(self._wake_read, False)
        os.set_blocking(self._wake_write, False)
        ready = threading.Event()
        self._thread = threading.Thread(
            target=self._run, args=(listener, ready), name="socket-server", daemon=True
        )
        self._thread.start()
        ready.wait()

    def send(self, client: str, event: str, data: dict[str, Any]) -> None:
        """Send an event to a client, from any thread; a client that has left is ignored."""
        self._outbox.append((client, event, data))
        self._wake()

    def close(self) -> None:
        """Close all connections and end the thread."""
        self._outbox.append(None)
        self._wake()
        self._thread.join(STOP_SECONDS)
        if not self._thread.is_alive():  # else, on a busy machine, it still waits at the pipe
            os.close(self._wake_read)
            os.close(self._wake_write)

    def _wake(self) -> None:
        with contextlib.suppress(BlockingIOError):  # full: it will wake up
            os.write(self._wake_write, b"x")

    def _run(self, plain: socket.socket, ready: threading.Event) -> None:
        # The default hub keeps an epoll object open beyond the end of its thread.
        eventlet.hubs.use_hub("poll")
        listener = eventlet.greenio.GreenSocket(plain)
        connections = Connections(self._limits.max_connections, self._report_refusal)
        server = self._socketio_server(connections)
        tasks = [
            eventlet.spawn(self._serve_http, listener, server, connections),
            eventlet.spawn(self._sweep, server),
        ]
        ready.set()
        self._pump(server)
        for task in tasks:
            task.kill()
        connections.kill_all()
        with contextlib.suppress(OSError):
            listener.close()

    def _serve_http(self, listener: Any, server: Any, connections: Connections) -> None:
        eventlet.wsgi.server(
            listener,
            Gate(
                accept_legacy_queries(socketio.WSGIApp(server)),
                self._access,
                has_room=server.eio.make_room,
                on_refused=self._report_refusal,
            ),
            log=logging.Logger("wsgi", logging.CRITICAL),
            log_output=False,
            custom_pool=connections,
            protocol=DeadlineHttpProtocol,
            socket_timeout=HTTP_TIMEOUT,
            debug=False,  # a client reads no traceback
        )

    def _socketio_server(self, connections: Connections) -> DualProtocolServer:
        log = logging.Logger("socketio", logging.ERROR)
        log.addHandler(_ErrorLog(self._on_event))
        server = DualProtocolServer(
            logger=log,
            engineio_logger=log,
            async_mode="eventlet",
            async_handlers=False,  # keeps the events of one client in order
            max_http_buffer_size=MAX_MESSAGE_BYTES,
            ping_timeout=PING_TIMEOUT,
            monitor_clients=False,  # a connection's own timeout does that, and the sweep
            http_compression=False,
            cors_allowed_origins=lambda origin, *_: True,  # the gate has refused all others
            cors_credentials=False,
            limits=self._limits,
            connections=connections,
        )
        server.on("connect", self._on_connect)
        server.on("disconnect", lambda client, *_: self._on_event(Disconnected(client)))
        server.on(
            TELEMETRY,
            lambda client, *wire: self._on_telemetry(server.receiver_of(client), client, wire),
        )
        return server

    def _on_connect(self, client: str, environ: dict[str, Any], *_: object) -> None:
        self._on_event(Connected(client, environ["REMOTE_ADDR"]))

    def _on_telemetry(self, receiver: Any, client: str, arguments: tuple[object, ...]) -> None:
        if receiver is not None:
            receiver.note_telemetry()
        wire = arguments[0] if len(arguments) == 1 else arguments
        self._on_event(TelemetryReceived(client, wire))

    def _report_refusal(self, address: str, reason: str) -> None:
        self._on_event(ConnectionRefused(address, reason))

    def _sweep(self, server: DualProtocolServer) -> None:
        while True:
            eventlet.sleep(SWEEP_SECONDS)
            server.eio.close_silent_sessions(time.monotonic() - self._limits.idle_limit)

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
                receiver = server.receiver_of(client)
                if receiver is not None:
                    receiver.flow.owed -= 1
                    server.emit(event, data, to=client)


def _listen(host: str, port: int) -> socket.socket:
    """Listens on an address of this machine, of IPv4 or IPv6; on `::` it takes both."""
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        listener = socket.socket(family, kind, protocol)
        try:
            if os.name != "nt":  # there it would let two servers share the port
                listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            if family == socket.AF_INET6:
                listener.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 0)
            listener.bind(address)
            listener.listen(128)
        except OSError:
            listener.close()
            raise
    except (OSError, ValueError, OverflowError) as error:
        if getattr(error, "errno", None) == errno.EADDRINUSE:
            raise PortInUseError(
                f"port {port} of {host} is in use: end the other program, or choose a port"
            ) from error
        cause = getattr(error, "strerror", None) or error
        raise ListenError(f"cannot listen on {host!r}, port {port}: {cause}") from error
    listener.setblocking(False)
    return listener
