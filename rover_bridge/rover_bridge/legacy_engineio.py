"""One Socket.IO server for all generations of clients.

Engine.IO 4 servers ping their clients, and wait for a Socket.IO connect packet. The Unity simulator
pings the server, and sends its events without ever connecting to a namespace; other clients of its
generation wait to be connected.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import engineio
import socketio
from engineio import packet

from rover_bridge.websocket_driver import FastWebSocketWSGI

SOCKETIO_CONNECT = "0"  # connect to the default namespace
WAITS_FOR_CONNECT = "rover_bridge.waits_for_connect"  # in the environ of a client that said EIO=3

WsgiApp = Callable[[dict[str, Any], Callable[..., Any]], Iterable[bytes]]


class BilingualEngineServer(engineio.Server):
    """An Engine.IO server whose sockets understand all generations."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._async: Any = {**self._async, "websocket": FastWebSocketWSGI}

    def _trigger_event(self, event: str, *args: Any, **kwargs: Any) -> Any:
        if event != "connect":
            return super()._trigger_event(event, *args, **kwargs)
        sid, environ = args
        receiver = BilingualReceiver(self.sockets[sid])
        self.sockets[sid].receive = receiver
        result = super()._trigger_event(event, *args, **kwargs)
        if environ.get(WAITS_FOR_CONNECT):
            receiver.connect()
        return result


class BilingualReceiver:
    """Receives the packets of one socket."""

    def __init__(self, socket: Any) -> None:
        self._socket = socket
        self._receive = socket.receive
        self._connected = False  # to the default namespace

    def connect(self) -> None:
        """Connect to the default namespace, as if the client had asked for it."""
        self._connected = True
        self._receive(packet.Packet(packet.MESSAGE, SOCKETIO_CONNECT))

    def __call__(self, received: packet.Packet) -> None:
        if received.packet_type == packet.PING:
            self._receive(packet.Packet(packet.PONG))  # who pings is alive
            self._socket.send(packet.Packet(packet.PONG, received.data))
            return
        if received.packet_type == packet.MESSAGE and not self._connected:
            self._connected = True
            if not str(received.data).startswith(SOCKETIO_CONNECT):
                self.connect()
        self._receive(received)


class BilingualServer(socketio.Server):
    """A Socket.IO server over it."""

    def _engineio_server_class(self) -> type[engineio.Server]:
        return BilingualEngineServer


def accept_older_queries(app: WsgiApp) -> WsgiApp:
    """Let WebSocket clients in that say EIO=3: the framing of their WebSocket is the same."""

    def accepting(environ: dict[str, Any], start_response: Callable[..., Any]) -> Iterable[bytes]:
        query = environ.get("QUERY_STRING", "")
        if "transport=websocket" in query and "EIO=3" in query:
            environ["QUERY_STRING"] = query.replace("EIO=3", "EIO=4")
            environ[WAITS_FOR_CONNECT] = True
        return app(environ, start_response)

    return accepting
