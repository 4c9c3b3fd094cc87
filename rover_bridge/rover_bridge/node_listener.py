"""The server of the bridge while it listens, and its events in the executor's thread."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.node import Node

from rover_bridge.config import BridgeConfig
from rover_bridge.inbox import Inbox
from rover_bridge.server import SocketServer
from rover_bridge.transport import ServerEvent, Transport

EVENTS_PER_TURN = 4  # taken from the inbox before commands and deadlines have their turn


class Listener:
    """A transport that may be opened and closed again; closed, it sends nothing."""

    def __init__(self, node: Node, on_event: Callable[[ServerEvent], None]) -> None:
        """on_event: called in the executor's thread."""
        self.port = 0  # that it listens on
        self._on_event = on_event
        self._server: Transport | None = None
        self._inbox = Inbox()
        self._arrival = node.create_guard_condition(self._on_arrivals)

    def open(self, config: BridgeConfig) -> None:
        """Raises AccessError, and OSError or an error of the project for a port that is taken."""
        limits, access = config.limits(), config.access()
        self._server = SocketServer(config.host, config.port, self._put, limits, access)
        self.port = self._server.port

    def send(self, client: str, event: str, data: dict[str, Any]) -> None:
        """As of a transport."""
        if self._server is not None:
            self._server.send(client, event, data)

    def close(self) -> None:
        """Close all connections, end the server's thread, and forget what has come."""
        if self._server is not None:
            self._server.close()
            self._server = None
            self._inbox = Inbox()

    def _put(self, event: ServerEvent) -> None:
        """Called in the server's thread."""
        self._inbox.put(event)
        self._arrival.trigger()

    def _on_arrivals(self) -> None:
        for _ in range(EVENTS_PER_TURN):
            if (event := self._inbox.take()) is None:
                return
            self._on_event(event)
        self._arrival.trigger()
