"""Who may talk to the server: the page that it served itself, and nobody else.

A browser sends the origin of the page with every WebSocket handshake, so that other sites cannot
drive the rover. A site whose name was made to point to this machine (DNS rebinding) has an origin
equal to its host; therefore the host must be an address or a name of this machine.
"""

from __future__ import annotations

import ipaddress
import socket
from urllib.parse import urlsplit


def is_own_host(host: str | None, listens_on: str) -> bool:
    """Whether a Host header names this machine: by address, as localhost, or by its own name."""
    name = _name_of(host or "")
    if name is None:
        return False
    if name in ("localhost", listens_on.lower(), socket.gethostname().lower()):
        return True
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def is_own_origin(origin: str | None, host: str | None) -> bool:
    """Whether an Origin header is that of a page which this server served under this host."""
    return bool(origin) and bool(host) and origin == f"http://{host}"


def _name_of(host: str) -> str | None:
    """Without the port; None for what is no host."""
    try:
        parts = urlsplit(f"//{host}")
        _ = parts.port  # raises for a port that is no number
    except ValueError:
        return None
    return None if parts.username is not None or parts.path else parts.hostname
