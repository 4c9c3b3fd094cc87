"""The seam between the node and a transport: what happens on the wire, and what is asked of it.

`server.SocketServer` is the transport in use. Another one, such as an ASGI server, only has to
report these events and to be a `Transport`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from rover_common.errors import RoverError


class ListenError(RoverError, OSError):
    """The address cannot be listened on."""


class PortInUseError(ListenError):
    """Another program listens on the port."""


@dataclass(frozen=True)
class Connected:
    """A client has joined the default namespace."""

    client: str
    address: str = ""  # of its machine


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


@dataclass(frozen=True)
class ConnectionRefused:
    """A connection or a request was refused; its other end was told the same."""

    address: str
    reason: str


ServerEvent = (
    Connected | Disconnected | TelemetryReceived | ProtocolErrorReported | ConnectionRefused
)
OnEvent = Callable[[ServerEvent], None]


@dataclass(frozen=True)
class WireLimits:
    """What one client, and all of them, may take."""

    max_connections: int = 64  # open at a time
    client_rate: float = 400.0  # [1/s] messages of one client that are read
    idle_limit: float = 60.0  # [s] without a message, after which a connection is closed


class Transport(Protocol):
    """Hands over what arrives by an `OnEvent`, called in a thread of its own; it must not block."""

    port: int  # that it listens on

    def send(self, client: str, event: str, data: dict[str, Any]) -> None:
        """Send an event to a client, from any thread; a client that has left is ignored."""

    def close(self) -> None:
        """Close all connections and end the thread."""
