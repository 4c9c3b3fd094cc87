"""One Socket.IO server for clients of Engine.IO 4 and of the legacy Engine.IO 3.

An Engine.IO 4 server pings its clients, and waits for a Socket.IO connect packet. The Unity
simulator speaks Engine.IO 3: it pings the server, and sends its events without ever connecting to a
namespace. Other legacy clients wait until the server connects them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import engineio
import socketio
from engineio import packet

from rover_bridge.fast_websocket import FastWebSocketWSGI

SOCKETIO_CONNECT = "0"  # connect to the default namespace
EXPECTS_CONNECT = "rover_bridge.expects_connect"  # in the environ of a client that said EIO=3

WsgiApp = Callable[[dict[str, Any], Callable[..., Any]], Iterable[bytes]]


class DualProtocolEngineServer(engineio.Server):
    """An Engine.IO server whose sockets understand both protocols."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._async: Any = {**self._async, "websocket": FastWebSocketWSGI}

    def _trigger_event(self, event: str, *args: Any, **kwargs: Any) -> Any:
        if event != "connect":
            return super()._trigger_event(event, *args, **kwargs)
        sid, environ = args
        receiver = DualProtocolReceiver(self.sockets[sid])
        self.sockets[sid].receive = receiver
        result = super()._trigger_event(event, *args, **kwargs)
        if environ.get(EXPECTS_CONNECT):
            receiver.connect()
        return result


class DualProtocolReceiver:
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
            self._receive(packet.Packet(packet.PONG))  # the library's proof that a client is alive
            self._socket.send(packet.Packet(packet.PONG, received.data))
            return
        if received.packet_type == packet.MESSAGE and not self._connected:
            self._connected = True
            if not str(received.data).startswith(SOCKETIO_CONNECT):
                self.connect()
        self._receive(received)


class DualProtocolServer(socketio.Server):
    """A Socket.IO server over it."""

    def _engineio_server_class(self) -> type[engineio.Server]:
        return DualProtocolEngineServer


def accept_legacy_queries(app: WsgiApp) -> WsgiApp:
    """Accept WebSocket clients that say EIO=3: the framing of their WebSocket is the same."""

    def accepting(environ: dict[str, Any], start_response: Callable[..., Any]) -> Iterable[bytes]:
        query = environ.get("QUERY_STRING", "")
        if "transport=websocket" in query and "EIO=3" in query:
            environ["QUERY_STRING"] = query.replace("EIO=3", "EIO=4")
            environ[EXPECTS_CONNECT] = True
        return app(environ, start_response)

    return accepting
