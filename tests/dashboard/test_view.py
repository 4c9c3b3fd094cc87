"""A recording in a browser: the slider moves the rover, and nothing can be driven."""

from __future__ import annotations

import asyncio

import chromium as browser_tools
import pytest
from chromium import Page, chromium
from test_playback import SECONDS, recorded

from rover_dashboard.view import serve_recording

pytestmark = pytest.mark.skipif(
    browser_tools.executable() is None,
    reason=f"no browser: none of {', '.join(browser_tools.EXECUTABLES)} is on the path",
)
HOST = "127.0.0.1"


def visible(selector: str) -> str:
    """Of JavaScript."""
    return f"document.querySelector('{selector}').checkVisibility()"


async def look_at(page: Page) -> None:
    assert await page.becomes("document.getElementById('link').textContent === 'recording'")
    assert await page.evaluate(visible("#playback"))
    assert not await page.evaluate(visible("#controls"))
    assert await page.evaluate("Number(document.getElementById('position').max)") == SECONDS
    await page.evaluate(
        """(() => {
          const slider = document.getElementById('position');
          slider.value = 25;
          for (const kind of ['input', 'change']) slider.dispatchEvent(new Event(kind));
        })()"""
    )
    assert await page.becomes("document.getElementById('state').textContent === 'S20'")
    assert await page.becomes(
        "document.getElementById('position-time').textContent === '0:25 of 1:00'"
    )
    await page.evaluate(
        """(() => {
          const speed = document.getElementById('playback-speed');
          speed.value = '30';
          speed.dispatchEvent(new Event('change'));
        })()"""
    )
    await page.click("#play")
    assert await page.becomes("document.getElementById('play').textContent === 'Pause'")
    assert await page.becomes("document.getElementById('state').textContent === 'S60'")
    assert await page.becomes("document.getElementById('play').textContent === 'Play'")


def test_the_slider_moves_the_rover():
    async def main() -> None:
        address: asyncio.Future[str] = asyncio.get_running_loop().create_future()
        source = recorded()
        names = {kept.topic for kept in source.kept}
        serving = asyncio.create_task(serve_recording(source, names, HOST, 0, address.set_result))
        try:
            async with chromium() as browser:
                page = await browser.new_page()
                await page.open(await address)
                await look_at(page)
                assert [error for error in page.errors if "image" not in error] == []
        finally:
            serving.cancel()

    asyncio.run(main())
