"""The scoreboard's page: what it links to, its plot, and that it fits a window."""

from __future__ import annotations

import asyncio
from html.parser import HTMLParser

import chromium as browser_tools
import pytest
from chromium import chromium
from mission_logs import mission_log
from scoreboard_rows import FILES, entry_of, failed_entry, job_of, row_of, store_in

from rover_tools.report.mission_page import mission_map
from rover_tools.scoreboard import report
from rover_tools.scoreboard.board import summaries
from rover_tools.scoreboard.mission_run import failed_row
from rover_tools.scoreboard.rover_board import BOARD
from rover_tools.scoreboard.scatter import scatter_of


def write_report(folder, entries):
    report.write_report(folder, BOARD, entries, summaries(BOARD, entries))


class Page(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.links += [value for key, value in attributes if key in ("src", "href")]

    def handle_data(self, data):
        self.text += data


def test_the_page_links_every_mission_to_its_files_and_nothing_from_outside(tmp_path):
    store = store_in(tmp_path)
    jobs = [job_of("tour"), job_of("frontier+bearing", seed=2)]
    for job in jobs:
        store.add(job, row_of(job), FILES)
    bad = job_of(seed=3)
    store.add(bad, failed_row(bad, RuntimeError("lost <its> way")), None)
    entries = store.entries()
    write_report(tmp_path, entries)
    text = (tmp_path / "report.html").read_text()
    page = Page(text)
    for name in ("seed-1", "seed-2", "seed-3", "failed: RuntimeError: lost <its> way"):
        assert name in page.text
    assert "100 %)" in page.text
    # of two missions: a point, a row and a map that lead to the report, and the map itself
    assert len(page.links) == 8
    for link in page.links:
        path = tmp_path / link.replace("%2B", "+")
        assert path.is_file(), link
    assert "http" not in text


def test_an_empty_report(tmp_path):
    write_report(tmp_path, [])
    assert "0 missions" in (tmp_path / "report.html").read_text()


def test_a_point_lies_on_the_ray_of_its_ratio():
    times = [(1, 200.0), (2, 300.0)]
    entries = [entry_of(job_of(seed=seed), time=time) for seed, time in times]
    entries.append(failed_entry(job_of("frontier", seed=3)))
    scatter = scatter_of(entries)
    assert scatter.strategies == ("tour",)
    rays = {ray.ratio: ray for ray in scatter.rays}
    for point, ratio in zip(scatter.points, (2, 3), strict=True):
        (x0, y0), (x1, y1) = rays[ratio].start, rays[ratio].end
        assert point.y == pytest.approx(y0 + (y1 - y0) * (point.x - x0) / (x1 - x0))
    ends = [value for ray in scatter.rays for value in (*ray.start, *ray.end)]
    assert all(-1e-9 < value < 100 + 1e-9 for value in ends)
    inside = [point.x for point in scatter.points] + [point.y for point in scatter.points]
    assert all(0 < value < 100 for value in inside)


def test_a_mission_that_did_not_achieve_all_is_an_open_point():
    rows = [{}, {"samples_collected": 5}, {"home_distance": 9.0}]
    entries = [entry_of(job_of(seed=seed), **row) for seed, row in enumerate(rows)]
    assert [point.achieved for point in scatter_of(entries).points] == [True, False, False]


def test_without_a_completed_mission_there_is_no_plot():
    assert scatter_of([failed_entry(job_of())]) is None


async def _widths(tmp_path) -> dict[int, tuple]:
    widths = {}
    async with chromium() as browser:
        page = await browser.new_page()
        for width in (1280, 390):
            await page.show_as(width, 800)
            await page.open((tmp_path / "report.html").as_uri())
            widths[width] = (
                await page.evaluate("document.documentElement.scrollWidth"),
                await page.becomes("document.querySelector('.maps img').naturalWidth > 0"),
                await page.evaluate("document.querySelector('.maps img').clientWidth") >= 320,
            )
        assert page.errors == []
    return widths


@pytest.mark.skipif(browser_tools.executable() is None, reason="no browser")
def test_page_and_maps_fit_a_desktop_and_a_phone(tmp_path):
    store = store_in(tmp_path)
    files = FILES | {".svg": mission_map(mission_log()).encode()}
    for strategy in ("tour", "classic_a+bearing"):
        for seed in (1, 2):
            job = job_of(strategy, seed)
            store.add(job, row_of(job), files)
    bad = job_of(seed=3)
    store.add(bad, failed_row(bad, RuntimeError("a long message " * 9 + "x" * 60)), None)
    entries = store.entries()
    write_report(tmp_path, entries)
    assert asyncio.run(_widths(tmp_path)) == {w: (w, True, True) for w in (1280, 390)}
