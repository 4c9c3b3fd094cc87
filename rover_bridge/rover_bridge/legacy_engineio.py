"""One Socket.IO server for clients of Engine.IO 4 and of the legacy Engine.IO 3.

An Engine.IO 4 server pings its clients, and waits for a Socket.IO connect packet. The Unity
simulator speaks Engine.IO 3: it pings the server, and sends its events without ever connecting to a
namespace. Other legacy clients wait until the server connects them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any
from urllib.parse import parse_qs

import engineio
import socketio
from engineio import packet

from rover_bridge.connections import Connection, Connections
from rover_bridge.flow_control import ClientFlow, StalledClientError
from rover_bridge.gate import WsgiApp
from rover_bridge.transport import WireLimits
from rover_bridge.wire_format import WirePacket
from rover_bridge.wire_websocket import WireWebSocketWSGI

SOCKETIO_CONNECT = "0"  # connect to the default namespace
EXPECTS_CONNECT = "rover_bridge.expects_connect"  # in the environ of a client that said EIO=3
SESSIONS_PER_CONNECTION = 2  # those of connections that made room end a little later
TELEMETRY = "telemetry"  # the one event that clients send


class DualProtocolEngineServer(engineio.Server):
    """An Engine.IO server whose sockets understand both protocols."""

    def __init__(
        self, *args: Any, limits: WireLimits, connections: Connections, **kwargs: Any
    ) -> None:
        super().__init__(*args, **kwargs)
        self.limits = limits
        self.connections = connections
        self._async: Any = {**self._async, "websocket": WireWebSocketWSGI}

    def close_silent_sessions(self, silent_since: float) -> None:
        """End the sessions of polling clients that were heard before this time [s] of the
        monotonic clock; a WebSocket has its own deadline.
        """
        for socket in [*self.sockets.values()]:
            receiver = socket.receive
            if not isinstance(receiver, DualProtocolReceiver):
                continue  # it connects at this moment
            if not socket.upgraded and receiver.flow.last_heard < silent_since:
                socket.close(wait=False)
                self.sockets.pop(socket.sid, None)

    def make_room(self) -> bool:
        """Whether one more session may begin; ends a polling one without a telemetry for it."""
        if len(self.sockets) < SESSIONS_PER_CONNECTION * self.limits.max_connections:
            return True
        idle = [
            socket
            for socket in self.sockets.values()
            if isinstance(socket.receive, DualProtocolReceiver)
            and not socket.upgraded
            and not socket.receive.sent_telemetry
        ]
        if idle:
            oldest = min(idle, key=lambda socket: float(socket.receive.flow.last_heard))
            oldest.close(wait=False)
            self.sockets.pop(oldest.sid, None)
        return bool(idle)

    def handle_request(
        self, environ: dict[str, Any], start_response: Callable[..., Any]
    ) -> Iterable[bytes]:
        """Also note on which connection a session is from now on."""
        sid = parse_qs(environ.get("QUERY_STRING", "")).get("sid", [""])[0]
        socket = self.sockets.get(sid)
        if socket is not None and isinstance(socket.receive, DualProtocolReceiver):
            socket.receive.follow(self.connections.of(environ))
        answer: Iterable[bytes] = super().handle_request(environ, start_response)
        return answer

    def _trigger_event(self, event: str, *args: Any, **kwargs: Any) -> Any:
        if event != "connect":
            return super()._trigger_event(event, *args, **kwargs)
        sid, environ = args
        socket = self.sockets[sid]
        socket.receive = receiver = DualProtocolReceiver(socket, self.limits.client_rate)
        receiver.follow(self.connections.of(environ))
        result = super()._trigger_event(event, *args, **kwargs)
        if environ.get(EXPECTS_CONNECT):
            receiver.connect()
        return result


class DualProtocolReceiver:
    """Receives the packets of one socket, at the rate of its flow."""

    def __init__(self, socket: Any, rate: float) -> None:
        self._socket = socket
        self._receive = socket.receive
        self._connection: Connection | None = None
        self._connected = False  # to the default namespace
        self._failure: Exception | None = None
        self.sent_telemetry = False
        self.flow = ClientFlow(rate, socket.queue.qsize, self._gone)

    def follow(self, connection: Connection | None) -> None:
        """The session is on this connection from now on."""
        self._connection = connection
        if connection is not None and self.sent_telemetry:
            connection.sent_telemetry = True

    def connect(self) -> None:
        """Connect to the default namespace, as if the client had asked for it."""
        self._connected = True
        self._receive(packet.Packet(packet.MESSAGE, SOCKETIO_CONNECT))

    def __call__(self, received: packet.Packet) -> None:
        try:
            self.flow.wait_turn()
        except StalledClientError as error:
            self._end(str(error))  # what waits for the client would not let it end
            raise
        if self._connection is not None:
            self._connection.heard = self.flow.last_heard
        if received.packet_type == packet.PING:
            self._receive(packet.Packet(packet.PONG))  # the library's proof that a client is alive
            self._socket.send(packet.Packet(packet.PONG, received.data))
        elif received.packet_type == packet.MESSAGE:
            self._receive_message(received)
        else:
            self._receive(received)
        if self._failure is not None:
            self._end(f"no packet: {type(self._failure).__name__}")
            raise self._failure

    def fail(self, error: Exception) -> None:
        """A message is no packet: its connection ends, so that nobody waits for an answer to it."""
        self._failure = error

    def _receive_message(self, received: packet.Packet) -> None:
        asks = str(received.data).startswith(SOCKETIO_CONNECT)
        namespace = str(received.data)[1:2] == "/"
        if asks and not namespace:
            if not self._connected:  # a second time would begin another session in this one
                self._connected = True
                self._receive(received)
            return
        if not self._connected:
            self.connect()
        self._receive(received)

    def _end(self, reason: str) -> None:
        if self._connection is not None and self._connection.is_websocket:
            self._connection.close("400 Bad Request", reason)
        else:
            self._socket.close(wait=False)

    def _gone(self) -> bool:
        connection = self._connection
        return connection is not None and connection.is_websocket and connection.gone()

    def note_telemetry(self) -> None:
        """The client sent one: it is owed an answer, and its connection is in use."""
        self.flow.owed += 1
        self.sent_telemetry = True
        if self._connection is not None:
            self._connection.sent_telemetry = True


class DualProtocolServer(socketio.Server):
    """A Socket.IO server over it."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(serializer=WirePacket, **kwargs)

    def receiver_of(self, client: str) -> DualProtocolReceiver | None:
        """That of a client; None when it has left."""
        socket = self.eio.sockets.get(self.manager.eio_sid_from_sid(client, "/"))
        return None if socket is None else socket.receive

    def _handle_eio_message(self, eio_sid: str, data: Any) -> None:
        """Engine.IO logs an error of this handler, and goes on."""
        try:
            super()._handle_eio_message(eio_sid, data)
        except Exception as error:
            self.eio.sockets[eio_sid].receive.fail(error)

    def _engineio_server_class(self) -> type[engineio.Server]:
        return DualProtocolEngineServer

    def _handle_event(self, eio_sid: str, namespace: str | None, id: int | None, data: Any) -> None:
        """Pass the telemetry on alone: the library takes an event for its own by its name, so that
        a client could report that it has connected or disconnected.
        """
        if isinstance(data, list) and data and data[0] == TELEMETRY:
            super()._handle_event(eio_sid, namespace, id, data)


def accept_legacy_queries(app: WsgiApp) -> WsgiApp:
    """Accept WebSocket clients that say EIO=3: the framing of their WebSocket is the same."""

    def accepting(environ: dict[str, Any], start_response: Callable[..., Any]) -> Iterable[bytes]:
        query = environ.get("QUERY_STRING", "")
        if "transport=websocket" in query and "EIO=3" in query:
            environ["QUERY_STRING"] = query.replace("EIO=3", "EIO=4")
            environ[EXPECTS_CONNECT] = True
        return app(environ, start_response)

    return accepting
