"""Serves the page, and each viewer's WebSocket: news at 20 Hz, requests in the other direction."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import suppress
from pathlib import Path

from aiohttp import WSMsgType, web

from rover_common.errors import RoverError
from rover_dashboard.access import is_own_host, is_own_origin
from rover_dashboard.feed import Feed, Seen
from rover_dashboard.protocol import (
    Answer,
    ProtocolError,
    Robot,
    answer_message,
    parse,
    settings_message,
)

STATIC = Path(__file__).parent / "static"
PERIOD = 0.05  # [s] between two looks for news
# [s] between two questions whether a viewer is there; within half of it, it has to answer. A busy
# machine's browser takes seconds, and who asked for something meanwhile would not hear of it.
HEARTBEAT = 60.0
MAX_VIEWERS = 16
MAX_MESSAGE = 4096  # bytes from a page
MAX_ASKED = 32  # wishes of one viewer that wait for their answers; more are read later
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:;"
        " connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-cache",
}
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class PortError(RoverError, OSError):
    """The server cannot listen where it should."""


class Server:
    """The page and its viewers."""

    def __init__(self, feed: Feed, robot: Robot, host: str) -> None:
        self._feed = feed
        self._robot = robot
        self._host = host
        self._viewers: set[web.WebSocketResponse] = set()
        app = web.Application(middlewares=[self._guard])
        app.router.add_get("/", self._page)
        app.router.add_get("/live", self._live)
        app.router.add_static("/", STATIC)
        app.on_shutdown.append(self._end_viewers)
        self._runner = web.AppRunner(app, access_log=None)

    async def start(self, port: int) -> int:
        """Listen; the port that was taken. Raises PortError."""
        await self._runner.setup()
        site = web.TCPSite(self._runner, self._host, port)
        try:
            await site.start()
        except OSError as error:
            await self._runner.cleanup()
            raise PortError(f"cannot listen on {self._host}:{port}: {error.strerror}") from error
        return int(self._runner.addresses[0][1])

    async def close(self) -> None:
        """End all connections."""
        await self._runner.cleanup()

    @web.middleware
    async def _guard(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Only under this machine's own names, and with the headers that every answer has."""
        if not is_own_host(request.headers.get("Host"), self._host):
            raise web.HTTPForbidden(text="unknown host", headers=HEADERS)
        response = await handler(request)
        if not response.prepared:
            response.headers.update(HEADERS)
        return response

    async def _page(self, _: web.Request) -> web.StreamResponse:
        return web.FileResponse(STATIC / "index.html")

    async def _live(self, request: web.Request) -> web.StreamResponse:
        """A viewer, until it leaves."""
        if not is_own_origin(request.headers.get("Origin"), request.headers.get("Host")):
            raise web.HTTPForbidden(text="only the page of this server may connect")
        if len(self._viewers) >= MAX_VIEWERS:
            raise web.HTTPServiceUnavailable(text="too many viewers")
        socket = web.WebSocketResponse(  # what is large is compressed already
            heartbeat=HEARTBEAT, max_msg_size=MAX_MESSAGE, compress=False
        )
        await socket.prepare(request)
        self._viewers.add(socket)
        self._robot.watch(True)
        tasks = {asyncio.create_task(self._pump(socket))}
        places = asyncio.Semaphore(MAX_ASKED)
        try:
            async for message in socket:  # also while the graph takes its time for an answer
                if message.type is WSMsgType.TEXT:
                    await places.acquire()
                    task = asyncio.create_task(self._answer(socket, message.data))
                    tasks.add(task)
                    task.add_done_callback(tasks.discard)
                    task.add_done_callback(lambda _: places.release())
        finally:
            for task in tasks:
                task.cancel()
            self._viewers.discard(socket)
            if not self._viewers:
                self._robot.watch(False)
        return socket

    async def _pump(self, socket: web.WebSocketResponse) -> None:
        """Send what is new; a slow viewer gets fewer, never older values."""
        seen = Seen()
        try:
            await socket.send_str(settings_message())
            while not socket.closed:
                for message in self._feed.news(seen):
                    if isinstance(message, str):
                        await socket.send_str(message)
                    else:
                        await socket.send_bytes(message)
                await asyncio.sleep(PERIOD)
        except ConnectionError:
            pass  # it left; the reading side ends as well

    async def _answer(self, socket: web.WebSocketResponse, text: str) -> None:
        try:
            ask = parse(text)
            answer = answer_message(ask.id, await self._robot.carry_out(ask.wish))
        except ProtocolError as error:
            answer = answer_message(-1, Answer(False, str(error)))
        with suppress(ConnectionError):  # it left
            await socket.send_str(answer)

    async def _end_viewers(self, _: web.Application) -> None:
        for socket in set(self._viewers):
            await socket.close(code=1001, message=b"the server ends")
