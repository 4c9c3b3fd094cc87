"""The server on a real socket, with a robot that only takes notes."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager

import pytest
from aiohttp import (
    ClientSession,
    ClientWebSocketResponse,
    WSCloseCode,
    WSMsgType,
    WSServerHandshakeError,
)

from rover_dashboard.feed import Feed
from rover_dashboard.history import History
from rover_dashboard.protocol import (
    SETTABLE,
    Answer,
    MissionRequest,
    ParameterChange,
    PlaybackChange,
    Wish,
)
from rover_dashboard.server import MAX_VIEWERS, STATIC, PortError, Server
from rover_dashboard.slots import Slots

HOST = "127.0.0.1"
WAIT = 10.0  # [s]


class Notes:
    """A Robot that does what it is asked for, and remembers it."""

    def __init__(self) -> None:
        self.asked: list[Wish] = []
        self.watched: asyncio.Queue[bool] = asyncio.Queue()
        self.slow: dict[str, asyncio.Event] = {}  # what a wish of this name waits for

    async def carry_out(self, wish: Wish) -> Answer:
        self.asked.append(wish)
        if wish.name in self.slow:
            await self.slow[wish.name].wait()
        return Answer(wish != MissionRequest("resume"), f"{wish.name}: done")

    def watch(self, watched: bool) -> None:
        self.watched.put_nowait(watched)


class Served:
    """A running server and a client of it."""

    def __init__(
        self, server: Server, session: ClientSession, port: int, slots: Slots, robot: Notes
    ) -> None:
        self.server, self.session, self.port = server, session, port
        self.slots, self.robot = slots, robot
        self.address = f"http://{HOST}:{port}"

    def connect(self, **headers: str):
        """As the page does, unless headers say something else."""
        sent = {"Origin": self.address} | headers
        return self.session.ws_connect(
            f"{self.address}/live", headers={k: v for k, v in sent.items() if v}
        )


def serving(test: Callable) -> Callable[[], None]:
    """Run a test, a coroutine function of a Served, beside a server."""

    def run() -> None:
        async def main() -> None:
            async with served() as it:
                await asyncio.wait_for(test(it), 4 * WAIT)

        asyncio.run(main())

    run.__name__ = test.__name__
    return run


@asynccontextmanager
async def served() -> AsyncIterator[Served]:
    slots, robot = Slots(), Notes()
    server = Server(Feed(slots, History()), robot, HOST)
    port = await server.start(0)
    async with ClientSession() as session:
        yield Served(server, session, port, slots, robot)
    await server.close()


async def receive(socket: ClientWebSocketResponse, slot: str) -> dict:
    """The data of the next text message of a slot."""
    while True:
        message = await socket.receive(WAIT)
        data = json.loads(message.data) if isinstance(message.data, str) else {}
        if data.get("slot") == slot:
            return data["data"]


@serving
async def test_the_page_and_its_modules_come_with_a_strict_policy(it: Served):
    for path in ("/", "/main.js", "/style.css", "/vendor/uplot/uPlot.esm.js"):
        async with it.session.get(it.address + path) as response:
            assert response.status == 200, path
            assert "default-src 'none'" in response.headers["Content-Security-Policy"]
            assert "https:" not in response.headers["Content-Security-Policy"]
            if path == "/":
                assert "<title>Rover</title>" in await response.text()


@serving
async def test_nothing_else_of_the_disk_is_served(it: Served):
    for path in ("/nothing", "/%2e%2e/server.py", "/..%2fserver.py", "/vendor/"):
        async with it.session.get(it.address + path) as response:
            assert response.status in (403, 404), path


@serving
async def test_the_page_gets_what_changed(it: Served):
    it.slots.put("mission", {"state": "FORWARD"})
    async with it.connect() as page:
        assert set(await receive(page, "settings")) == set(SETTABLE)
        assert await receive(page, "mission") == {"state": "FORWARD"}
        it.slots.put("mission", {"state": "STOP"})
        assert await receive(page, "mission") == {"state": "STOP"}


@serving
async def test_a_wish_that_takes_its_time_holds_up_no_other(it: Served):
    it.robot.slow["pause"] = asyncio.Event()
    async with it.connect() as page:
        await page.send_json({"id": 1, "request": "pause"})
        await page.send_json({"id": 2, "request": "start"})
        assert (await receive(page, "answer"))["id"] == 2
        it.robot.slow["pause"].set()
        assert (await receive(page, "answer"))["id"] == 1


@serving
async def test_a_request_and_a_parameter_reach_the_robot_and_are_answered(it: Served):
    async with it.connect() as page:
        await page.send_json({"id": 7, "request": "pause"})
        assert await receive(page, "answer") == {"id": 7, "ok": True, "text": "pause: done"}
        await page.send_json({"id": 8, "request": "resume"})
        assert (await receive(page, "answer"))["ok"] is False
        await page.send_json({"id": 9, "set": "top_speed", "value": 2})
        assert (await receive(page, "answer"))["id"] == 9
        await page.send_json({"id": 10, "playback": "position", "value": 12.5})
        assert (await receive(page, "answer"))["id"] == 10
        await page.send_json({"id": 11, "playback": "colour", "value": 1})
        assert (await receive(page, "answer"))["ok"] is False
        await page.send_str("nonsense")
        assert await receive(page, "answer") == {"id": -1, "ok": False, "text": "no JSON"}
    assert it.robot.asked == [
        MissionRequest("pause"),
        MissionRequest("resume"),
        ParameterChange("top_speed", 2.0),
        PlaybackChange("position", 12.5),
    ]


@serving
async def test_another_origin_a_missing_one_and_an_unknown_host_are_refused(it: Served):
    evil = f"evil.example:{it.port}"
    for headers in (
        {"Origin": "http://evil.example"},
        {"Origin": ""},
        {"Origin": "null"},
        {"Origin": f"http://localhost:{it.port}"},
        {"Origin": f"http://{evil}", "Host": evil},  # DNS rebinding
    ):
        with pytest.raises(WSServerHandshakeError) as refused:
            await it.connect(**headers)
        assert refused.value.status == 403, headers
    async with it.session.get(it.address, headers={"Host": evil}) as response:
        assert response.status == 403
    assert it.robot.watched.empty()
    assert it.robot.asked == []


@serving
async def test_the_robot_is_watched_from_the_first_viewer_to_the_last(it: Served):
    next_note = it.robot.watched.get
    first = await it.connect()
    assert await next_note()
    second = await it.connect()
    assert await next_note()
    await first.close()
    await second.close()
    assert not await next_note()
    assert it.robot.watched.empty()


@serving
async def test_one_viewer_too_many_is_refused(it: Served):
    pages = [await it.connect() for _ in range(MAX_VIEWERS)]
    with pytest.raises(WSServerHandshakeError) as refused:
        await it.connect()
    assert refused.value.status == 503
    for page in pages:
        await page.close()


def test_a_port_that_is_taken_is_an_expected_error():
    async def main() -> None:
        async with served() as it:
            other = Server(Feed(Slots(), History()), Notes(), HOST)
            with pytest.raises(PortError, match=f"{HOST}:{it.port}"):
                await other.start(it.port)

    asyncio.run(main())


def test_the_page_asks_no_other_host_for_anything():
    own = [path for path in STATIC.rglob("*") if path.is_file() and "vendor" not in path.parts]
    for path in own:
        text = path.read_text().replace("http://www.w3.org/2000/svg", "")
        assert "http://" not in text, path.name
        assert "https://" not in text, path.name
        assert len(text.splitlines()) <= 250, path.name


@serving
async def test_the_viewers_end_with_the_server(it: Served):
    page = await it.connect()
    await receive(page, "settings")
    await it.server.close()
    message = await page.receive(WAIT)
    while message.type is WSMsgType.TEXT:
        message = await page.receive(WAIT)
    assert message.type is WSMsgType.CLOSE
    assert message.data in (WSCloseCode.GOING_AWAY, WSCloseCode.OK)  # OK by an older aiohttp
