"""Measures what the live page costs over time: memory of node and browser, latency of the drive.

Run by hand, on an idle machine:

./rover shell -c 'PYTHONPATH=tests:tests/dashboard:$PYTHONPATH python tests/dashboard/soak.py'

A mission drives in real time, again and again. The page stays open for so many minutes, while the
memory of the dashboard node and of the browser is taken; then it is closed and opened in turns,
and the time from telemetry to command is taken in each turn. Prints one JSON object.
"""

from __future__ import annotations

import asyncio
import json
import os
import statistics
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import click
import psutil
from chromium import Browser, Page, chromium
from latency import Latency
from watched_graph import Watched, watched_graph

from rover_common import topics

SEED, SIZE = 2, 1.0
SAMPLE = 15.0  # [s] between two looks at the memory
SETTLE = 10.0  # [s] of each turn that do not count
SETTLED = 5.0  # [min] of the beginning in which memory may grow: caches, the browser's own start
MEBIBYTE = 2**20


def dashboard_process() -> psutil.Process:
    """The dashboard node among the children of this process."""
    for process in psutil.Process().children(recursive=True):
        if "dashboard_node" in " ".join(process.cmdline()):
            return process
    raise click.ClickException("no dashboard node runs")


def browser_bytes() -> int:
    """Of all the browser's processes; what they share counts once."""
    total = 0
    for process in psutil.Process().children(recursive=True):
        with suppress(psutil.NoSuchProcess):
            if "chrom" in process.name():
                total += process.memory_full_info().pss
    return total


async def start_again(watched: Watched, page: Page) -> None:
    """A mission that is over begins again."""
    mission = watched.run.watch.mission
    if mission is not None and mission.state_name == "DONE":
        await page.click("[data-request=start]")
    watched.run.processes.check()


async def memory(watched: Watched, page: Page, minutes: float) -> list[tuple[float, ...]]:
    """Rows of time [min], node, browser [MiB], heap of the page [MiB] and its nodes."""
    node = dashboard_process()
    await page.send("Performance.enable")
    start = time.monotonic()
    rows = []
    while (elapsed := (time.monotonic() - start) / 60) < minutes:
        metrics = {
            metric["name"]: metric["value"]
            for metric in (await page.send("Performance.getMetrics"))["metrics"]
        }
        sizes = node.memory_info().rss, browser_bytes(), metrics["JSHeapUsedSize"]
        rows.append((elapsed, *(size / MEBIBYTE for size in sizes), metrics["Nodes"]))
        click.echo(" ".join(f"{value:8.1f}" for value in rows[-1]), err=True)
        await start_again(watched, page)
        await asyncio.sleep(SAMPLE)
    return rows


async def turn(watched: Watched, page: Page | None, latency: Latency, seconds: float) -> float:
    """The median latency [ms]; page: that which is open."""
    await asyncio.sleep(SETTLE)
    latency.laps = []
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if page is not None:
            await start_again(watched, page)
        await asyncio.sleep(1.0)
    return statistics.median(latency.laps)


async def in_turns(
    watched: Watched, browser: Browser, page: Page, pairs: int, seconds: float
) -> tuple[list[float], list[float], int]:
    """Median latencies [ms] of the turns closed and open; subscriptions left while closed."""
    node = watched.run.watch.node
    latency = Latency(node)
    closed, opened, left = [], [], 0
    for _ in range(pairs):
        await page.send("Page.navigate", url="about:blank")
        closed.append(await turn(watched, None, latency, seconds))
        left += sum(map(node.count_subscribers, (topics.VISION_IMAGE, topics.MISSION_MARKERS)))
        await page.open(watched.address)
        opened.append(await turn(watched, page, latency, seconds))
        click.echo(f"closed {closed[-1]:.2f} ms, open {opened[-1]:.2f} ms", err=True)
    return closed, opened, left


def growth(rows: list[tuple[float, ...]], column: int) -> dict[str, float]:
    """Medians of the first and of the last quarter after the beginning, and their ratio."""
    values = [row[column] for row in rows if row[0] > min(SETTLED, rows[-1][0] / 2)]
    quarter = max(1, len(values) // 4)
    first, last = statistics.median(values[:quarter]), statistics.median(values[-quarter:])
    return {"first": round(first, 1), "last": round(last, 1), "ratio": round(last / first, 3)}


async def soak(watched: Watched, minutes: float, pairs: int, seconds: float) -> dict[str, object]:
    async with chromium() as browser:
        page = await browser.new_page()
        await page.show_as(1280, 860)
        await page.open(watched.address)
        rows = await memory(watched, page, minutes)
        closed, opened, left = await in_turns(watched, browser, page, pairs, seconds)
        ratios = [after / before for before, after in zip(closed, opened, strict=True)]
        return {
            "minutes": round(rows[-1][0], 1),
            "node_mib": growth(rows, 1),
            "browser_mib": growth(rows, 2),
            "heap_mib": growth(rows, 3),
            "dom_nodes": growth(rows, 4),
            "latency_ms_closed": round(statistics.median(closed), 2),
            "latency_ms_open": round(statistics.median(opened), 2),
            "latency_ratio": round(statistics.median(ratios), 3),
            "pairs": pairs,
            "subscriptions_left": left,
            "runs": watched.run.watch.mission.run if watched.run.watch.mission else 0,
            "errors": page.errors,
            "load": os.getloadavg()[0],
        }


@click.command()
@click.option("--minutes", type=float, default=30.0, help="With the page open.")
@click.option("--pairs", type=int, default=10, help="Turns closed and open.")
@click.option("--seconds", type=float, default=60.0, help="Of each turn.")
def main(minutes: float, pairs: int, seconds: float) -> None:
    """Measure, and print one JSON object."""
    with (
        tempfile.TemporaryDirectory() as folder,
        watched_graph(Path(folder), SEED, SIZE, "1") as watched,
    ):
        click.echo(json.dumps(asyncio.run(soak(watched, minutes, pairs, seconds))))


if __name__ == "__main__":
    main()
