"""Who may connect: programs, and pages of origins that are allowed; with a token if one is set.

A browser sends the origin of its page with every WebSocket handshake and every POST; programs send
none, or the address that they connect to. So any other origin is a page of somebody else's, which
would drive the rover through a visitor's browser. A site whose name was made to point to this
machine (DNS rebinding) has an origin with that name; therefore a name of its own is no origin of
this server's.
"""

from __future__ import annotations

import hmac
import ipaddress
import re
import socket
from dataclasses import dataclass
from urllib.parse import parse_qs, urlsplit

from rover_common.errors import RoverError

ORIGIN = re.compile(r"https?://[^\s/*]+")
TOKEN = re.compile(r"[\w.~-]+", re.ASCII)  # what a query carries as it is
OWN_SITES = ("", "none", "same-origin")  # of Sec-Fetch-Site, which browsers send


class AccessError(RoverError, ValueError):
    """A setting of the access is none."""


@dataclass(frozen=True)
class Request:
    """What a request says of itself."""

    query: str = ""
    origin: str = ""
    fetch_site: str = ""
    authorization: str = ""
    address: str = "127.0.0.1"  # of this machine, that the client has connected to
    port: int = 4567  # of this server


class Access:
    """Decides over requests; raises AccessError for settings that are none."""

    def __init__(self, allowed_origins: str = "", token: str = "") -> None:
        """allowed_origins: separated by spaces or commas; token: empty for none."""
        self._origins = frozenset(allowed_origins.replace(",", " ").split())
        for origin in self._origins:
            if not ORIGIN.fullmatch(origin):
                raise AccessError(f"allowed_origins: '{origin}' is not scheme://host:port")
        if token and not TOKEN.fullmatch(token):
            raise AccessError("token: only letters, digits and . _ ~ - may be in it")
        self._token = token

    def refusal(self, request: Request) -> str:
        """Why this request is refused; empty when it is accepted."""
        if request.origin:
            if request.origin not in self._origins and not _is_own(request):
                return f"origin {request.origin:.100} is not one of the allowed origins"
        elif request.fetch_site not in OWN_SITES:
            return "a page of another site asks without its origin"
        if self._token and not self._shows_token(request):
            return "the token is missing or wrong: add token=TOKEN to the query"
        return ""

    def _shows_token(self, request: Request) -> bool:
        shown = parse_qs(request.query).get("token", [])
        shown.append(request.authorization.removeprefix("Bearer "))
        wanted = self._token.encode()
        return any(hmac.compare_digest(text.encode(), wanted) for text in shown)


def _is_own(request: Request) -> bool:
    """Whether the origin is the address of this server, or this machine's own name."""
    try:
        parts = urlsplit(request.origin)
        port = parts.port or 80
    except ValueError:
        return False
    if parts.scheme != "http" or port != request.port or parts.path:
        return False
    own, name = _address_of(request.address), (parts.hostname or "").lower()
    if name == "localhost":
        return own is not None and own.is_loopback
    return name == socket.gethostname().lower() or (own is not None and _address_of(name) == own)


def _address_of(text: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    """None for what is no address; an IPv4 address that came through IPv6 is one of IPv4."""
    try:
        address = ipaddress.ip_address(text.partition("%")[0])
    except ValueError:
        return None
    return getattr(address, "ipv4_mapped", None) or address
