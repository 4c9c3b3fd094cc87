"""What an HTTP request has to be, before it reaches the Socket.IO server."""

from __future__ import annotations

import io
import time
from collections.abc import Callable, Iterable
from typing import Any
from urllib.parse import parse_qs

import eventlet

from rover_bridge.access import Access, Request
from rover_bridge.rate_limit import TokenBucket
from rover_bridge.wire_format import MAX_MESSAGE_BYTES, WireError, check_packet
from rover_common.errors import RoverError

WsgiApp = Callable[[dict[str, Any], Callable[..., Any]], Iterable[bytes]]

BODY_SECONDS = 10.0  # [s] in which a request's body has to arrive
SESSION_RATE = 100.0  # [1/s] sessions that begin
SEPARATOR = "\x1e"  # of the packets of one POST


class RequestError(RoverError):
    """A request that is refused."""

    def __init__(self, status: str, reason: str) -> None:
        super().__init__(reason)
        self.status = status


class Gate:
    """A WSGI application in front of the server's: refuses, and tells why."""

    def __init__(
        self,
        app: WsgiApp,
        access: Access,
        has_room: Callable[[], bool],
        on_refused: Callable[[str, str], None],
    ) -> None:
        """has_room: whether another session may begin; on_refused: address and reason."""
        self._app = app
        self._access = access
        self._has_room = has_room
        self._on_refused = on_refused
        self._sessions = TokenBucket(SESSION_RATE, SESSION_RATE)

    def __call__(
        self, environ: dict[str, Any], start_response: Callable[..., Any]
    ) -> Iterable[bytes]:
        """Pass the request on, or answer it with the reason why it is refused."""
        try:
            self._check(environ)
        except RequestError as error:
            self._on_refused(environ["REMOTE_ADDR"], str(error))
            body = f"{error}\n".encode()
            headers = [("Content-Type", "text/plain"), ("Content-Length", str(len(body)))]
            start_response(error.status, [*headers, ("Connection", "close")])
            return [body]
        return self._app(environ, start_response)

    def _check(self, environ: dict[str, Any]) -> None:
        refusal = self._access.refusal(_request_of(environ))
        if refusal:
            raise RequestError("403 Forbidden", refusal)
        query = parse_qs(environ.get("QUERY_STRING", ""))
        if "j" in query:
            raise RequestError("400 Bad Request", "JSONP is not served")
        if environ["REQUEST_METHOD"] == "POST":
            environ["wsgi.input"] = io.BytesIO(_body_of(environ))
        elif "sid" not in query:
            eventlet.sleep(self._sessions.take(time.monotonic()))
            if not self._has_room():
                raise RequestError("503 Service Unavailable", "too many sessions are open")
        # A message is decompressed as a whole, to any size: no extension is taken.
        environ.pop("HTTP_SEC_WEBSOCKET_EXTENSIONS", None)


def _request_of(environ: dict[str, Any]) -> Request:
    return Request(
        query=environ.get("QUERY_STRING", ""),
        origin=environ.get("HTTP_ORIGIN", "") or environ.get("HTTP_SEC_WEBSOCKET_ORIGIN", ""),
        fetch_site=environ.get("HTTP_SEC_FETCH_SITE", ""),
        authorization=environ.get("HTTP_AUTHORIZATION", ""),
        address=environ["SERVER_NAME"],
        port=int(environ["SERVER_PORT"]),
    )


def _body_of(environ: dict[str, Any]) -> bytes:
    """The packets of a POST, checked."""
    if "HTTP_TRANSFER_ENCODING" in environ:
        raise RequestError("411 Length Required", "a body without its length")
    length = int(environ.get("CONTENT_LENGTH") or 0)  # checked by the HTTP server
    if length > MAX_MESSAGE_BYTES:
        raise RequestError("413 Content Too Large", f"a body of {length} bytes")
    try:
        with eventlet.Timeout(BODY_SECONDS):
            body: bytes = environ["wsgi.input"].read(length)
    except eventlet.Timeout:
        raise RequestError("408 Request Timeout", "the request's body is not whole") from None
    try:
        for text in body.decode().split(SEPARATOR):
            check_packet(text)
    except (WireError, UnicodeDecodeError) as error:
        raise RequestError("400 Bad Request", f"no packet: {error}") from None
    return body
