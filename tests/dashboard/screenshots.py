"""Makes the pictures of the README: the live page during a mission, wide and on a phone.

python tests/dashboard/screenshots.py [--seconds 120] [--out docs/images]
"""

from __future__ import annotations

import asyncio
import sys
import tempfile
from pathlib import Path

import click

sys.path.insert(0, str(Path(__file__).parent))

from chromium import chromium
from watched_graph import watched_graph

ROOT = Path(__file__).resolve().parents[2]
SEED, SIZE = 1, 0.4  # the canyon of `./rover demo`
START = 900.0  # [s] to wait for the moment
# name, width and height [px], pixels of the screen to one of it, dark
PICTURES = (
    ("dashboard", 1280, 860, 1.0, False),
    ("dashboard_dark", 1280, 860, 1.0, True),
    ("dashboard_phone", 390, 1400, 1.0, False),
)
SETTLED = "new Promise((done) => setTimeout(done, 1500))"  # for the new layout to be drawn


async def take(address: str, seconds: int, out: Path) -> None:
    """When the mission is so old [s]."""
    async with chromium() as browser:
        page = await browser.new_page()
        await page.show_as(1280, 860)
        await page.open(address)
        moment = f"document.documentElement.dataset.elapsed >= {seconds}"
        if not await page.becomes(moment, START):
            raise click.ClickException("the mission did not come that far")
        for name, width, height, scale, dark in PICTURES:
            await page.show_as(width, height, scale=scale, dark=dark)
            await page.evaluate(SETTLED)
            await page.screenshot(out / f"{name}.png")
        for error in page.errors:
            click.echo(error, err=True)


@click.command()
@click.option("--seconds", type=int, default=120, help="Mission time of the pictures.")
@click.option("--out", type=click.Path(path_type=Path), default=ROOT / "docs" / "images")
def main(seconds: int, out: Path) -> None:
    """Run a mission and take the pictures."""
    with (
        tempfile.TemporaryDirectory() as folder,
        watched_graph(Path(folder), SEED, SIZE, "fast") as watched,
    ):
        asyncio.run(take(watched.address, seconds, out))


if __name__ == "__main__":
    main()
