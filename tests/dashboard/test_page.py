"""The page in a browser, beside a mission in the embedded simulator: it shows, and it is obeyed."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import chromium as browser_tools
import pytest
from aiohttp import ClientSession
from chromium import Browser, Page, chromium
from rover_interfaces.msg import MissionState
from watched_graph import Watched, watched_graph

from rover_common import topics

pytestmark = pytest.mark.skipif(
    browser_tools.executable() is None,
    reason=f"no browser: none of {', '.join(browser_tools.EXECUTABLES)} is on the path",
)
PATIENCE = 60.0  # [s] for the graph to obey
SEED, SIZE = 1, 0.6


async def until(predicate: Callable[[], Any], timeout: float = PATIENCE) -> bool:
    """Whether a predicate holds in time [s]."""
    end = time.monotonic() + timeout
    while not predicate():
        if time.monotonic() > end:
            return False
        await asyncio.sleep(0.05)
    return True


def text_is(selector: str, text: str) -> str:
    """Of JavaScript."""
    return f"document.querySelector('{selector}').textContent === {json.dumps(text)}"


class Driver:
    """A person at the page, who also sees what the graph says."""

    def __init__(self, page: Page, watched: Watched) -> None:
        self.page = page
        self.watch = watched.run.watch

    @property
    def mission(self) -> MissionState:
        assert self.watch.mission is not None
        return self.watch.mission

    async def press(self, request: str, *states: str) -> None:
        """Press a button until the mission has one of these states, on the page as well."""
        await self.page.click(f"[data-request={request}]")
        assert await until(lambda: self.mission.state_name in states), (request, self.mission)
        shown = " || ".join(text_is("#state", state) for state in states)
        assert await self.page.becomes(shown), request

    async def choose(self, parameter: str, value: str) -> None:
        control = f"document.querySelector('[data-parameter={parameter}]')"
        assert await self.page.becomes(f"!{control}.disabled")
        change = (
            f"{control}.value = {json.dumps(value)}; {control}.dispatchEvent(new Event('change'))"
        )
        for _ in range(2):  # again, as a person would, where a busy graph has not answered
            await self.page.evaluate(change)
            if await self.page.becomes(text_is("#answer", f"{parameter} is {value}")):
                return
        raise AssertionError(f"{parameter}: the page says '{await self.page.text('#answer')}'")


async def shows_the_mission(driver: Driver) -> None:
    page = driver.page
    assert await page.becomes(text_is("#link", "live"))
    far = "parseFloat(document.getElementById('driven').textContent) >= 4"
    assert await page.becomes(far, PATIENCE)
    for picture in ("camera", "vision"):
        assert await page.becomes(text_is(f"[data-picture={picture}] figcaption", "live"))
        assert await page.becomes(
            f"document.getElementById('{picture}').getContext('2d')"
            ".getImageData(160, 120, 1, 1).data[3] === 255"
        )
    assert await page.becomes("parseFloat(document.getElementById('ground').textContent) > 10")
    assert await page.becomes("document.querySelectorAll('#transitions li').length > 0")
    assert await page.becomes("document.querySelectorAll('#plots canvas').length === 5")


async def obeys(driver: Driver) -> None:
    """Every parameter and every button."""
    await driver.choose("explorer", "classic_b")
    assert await until(
        lambda: driver.mission.reason in ("follows the wall", "turns to find free ground")
    )
    await driver.choose("top_speed", "0.7")
    await driver.choose("way_home", "shortest_path")
    await driver.press("pause", "PAUSED")
    await driver.press("resume", "FORWARD", "STOP")
    assert await driver.page.becomes(
        "Math.abs(parseFloat(document.getElementById('speed').textContent)) <= 1"
    )
    await driver.press("return_home", "RETURN_HOME", "DONE")
    await driver.choose("top_speed", "3.6")
    assert await until(lambda: driver.mission.state_name == "DONE")
    run = driver.mission.run
    await driver.press("start", "FORWARD", "STOP")
    assert await until(lambda: driver.mission.run == run + 1)
    await driver.page.click("[data-request=reset]")
    assert await until(lambda: driver.mission.run == run + 2)
    assert await driver.page.becomes(text_is("#run", str(run + 2)))


async def gives_a_late_viewer_the_track(browser: Browser, address: str) -> None:
    """A second page is as far as the first one at once."""
    page = await browser.new_page()
    await page.open(address)
    assert await page.becomes("document.querySelectorAll('#transitions li').length > 0")
    assert page.errors == []
    await page.send("Page.close")
    headers = {"Origin": address.rstrip("/")}
    async with (
        ClientSession() as session,
        session.ws_connect(f"{address}live", headers=headers) as socket,
    ):
        async for message in socket:
            data = json.loads(message.data) if isinstance(message.data, str) else {}
            if data.get("slot") == "track":
                assert data["data"]["restart"]
                assert len(data["data"]["rows"]) > 5
                return


async def is_refused_elsewhere(browser: Browser, address: str) -> None:
    """A page of another origin in the same browser cannot connect."""
    page = await browser.new_page()
    await page.open("data:text/html,<title>elsewhere</title>")
    outcome = await page.evaluate(
        f"""new Promise((resolve) => {{
          const socket = new WebSocket("{address.replace("http", "ws")}live");
          socket.onopen = () => resolve("open");
          socket.onerror = () => resolve("refused");
        }})"""
    )
    assert outcome == "refused"
    await page.send("Page.close")


async def look_at(watched: Watched) -> None:
    watcher = watched.run.watch.node
    assert watcher.count_subscribers(topics.VISION_IMAGE) == 0
    async with chromium() as browser:
        page = await browser.new_page()
        await page.open(watched.address)
        driver = Driver(page, watched)
        assert await until(lambda: watcher.count_subscribers(topics.VISION_IMAGE) == 1)
        await shows_the_mission(driver)
        await gives_a_late_viewer_the_track(browser, watched.address)
        await is_refused_elsewhere(browser, watched.address)
        await obeys(driver)
        assert page.errors == []
        await page.send("Page.close")
        for topic in (topics.VISION_IMAGE, topics.PLAN, topics.MISSION_MARKERS):
            assert await until(lambda t=topic: watcher.count_subscribers(t) == 0), topic
    watched.run.processes.check()


def test_the_page_shows_the_mission_and_is_obeyed(tmp_path: Path):
    with watched_graph(tmp_path, SEED, SIZE, "fast") as watched:
        asyncio.run(look_at(watched))
