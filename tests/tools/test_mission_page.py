"""The report of a mission: what is in it, and how a browser shows it without a network."""

from __future__ import annotations

import asyncio
import re
import xml.etree.ElementTree as ElementTree

import chromium as browser_tools
import numpy as np
import pytest
from chromium import chromium
from mission_logs import ROOM, TRUTH, grid_of, mission_log

from rover_tools.evaluation.results import Truth
from rover_tools.report.map_layers import cells_path, track_layers
from rover_tools.report.mission_log import LogBuilder, MissionLog
from rover_tools.report.mission_page import mission_map, mission_page
from rover_tools.report.plots import plots_of, seconds_by_state, spans_of, time_ticks
from rover_tools.report.video.snapshot import Video

LOGS = {
    "truth": mission_log(),
    "no truth": mission_log(Truth()),
    "no map": MissionLog("t", mission_log().track, mission_log().changes, None, (), TRUTH, {}),
    "no frame": LogBuilder(TRUTH).log("empty", None, (), {}),
}
needs_browser = pytest.mark.skipif(browser_tools.executable() is None, reason="no browser")


@pytest.mark.parametrize("name", LOGS)
def test_nothing_comes_from_outside(name):
    page = mission_page(LOGS[name])
    outside = page.replace('xmlns="http://www.w3.org/2000/svg"', "")
    assert "://" not in outside
    assert not re.search(r"""(src|href)=|url\(|@import|\bimport\b""", outside)


def test_a_video_is_a_file_beside_the_page():
    page = mission_page(LOGS["truth"], Video("mission.webm", 4.0))
    assert '<video src="mission.webm" data-seconds="4.0"' in page


def test_names_are_text_not_markup():
    log = MissionLog("<b>bold</b>", (), (), None, (), Truth(), {"reason": "</style><i>"})
    page = mission_page(log)
    assert "<b>bold" not in page
    assert "</style><i>" not in page


def test_the_map_is_a_file_of_its_own():
    root = ElementTree.fromstring(mission_map(LOGS["truth"]))
    kinds = {element.get("class") for element in root.iter()}
    assert {"right", "wrong", "missing", "sample", "rock"} <= kinds
    root = ElementTree.fromstring(mission_map(LOGS["no truth"]))
    assert {"ground", "obstacle"} <= {element.get("class") for element in root.iter()}


def test_runs_of_cells_become_rectangles():
    mask = np.zeros((200, 200), bool)
    mask[2, 3:5] = mask[2, 7] = True
    assert cells_path(mask, grid_of(ROOM)) == "M3 -3h2v1h-2zM7 -3h1v1h-1z"


def test_the_track_changes_colour_where_the_state_changes():
    lines = track_layers(LOGS["truth"].track)
    assert [line.kind for line in lines] == ["FORWARD", "RETURN_HOME"]
    forward, back = (line.path.removeprefix("M").split("L") for line in lines)
    assert forward[1].endswith(" " + back[0])


def test_plots_show_shares_with_a_truth_and_area_without():
    titles = [plot.title for plot in plots_of(LOGS["truth"].track)]
    assert "Mapped, fidelity [%]" in titles
    assert "Mapped ground [m²]" in [plot.title for plot in plots_of(LOGS["no truth"].track)]
    explored = plots_of(LOGS["no truth"].track)[-3]
    assert explored.title == "Explored, as the rover estimates [%]"
    assert explored.lines[0].values[40] == 40.0
    assert plots_of(()) == []


def test_lines_fill_the_square_from_the_start_to_the_end():
    home = plots_of(LOGS["truth"].track)[-1]
    points = [tuple(map(float, point.split(","))) for point in home.lines[0].points.split()]
    assert (points[0], points[-1]) == ((0.0, 100.0), (1000.0, 100.0))
    assert points[40] == (500.0, 0.0)  # 40 m is the highest tick


def test_stays_add_up_to_the_duration():
    spans = spans_of(LOGS["truth"].changes, 80.0)
    assert sum(span.width for span in spans) == pytest.approx(100.0)
    assert seconds_by_state(spans) == {
        "FORWARD": pytest.approx(40.1),
        "RETURN_HOME": pytest.approx(39.9),
    }
    assert (
        spans_of(LOGS["truth"].changes, 40.0999)[-1].width == 0.0
    )  # the track's times are rounded
    assert [tick.at for tick in time_ticks(80.0)] == [0.0, 25.0, 50.0, 75.0, 100.0]


PAINTED = """(() => {
  const box = (each) => each.getBoundingClientRect();
  return [...document.querySelectorAll('.cells, .track, polyline')]
    .every((each) => box(each).width > 50) && document.querySelectorAll('polyline').length;
})()"""


async def _shown(tmp_path) -> dict[int, tuple]:
    path = tmp_path / "report.html"
    path.write_text(mission_page(LOGS["truth"]))
    shown = {}
    async with chromium() as browser:
        page = await browser.new_page()
        await page.send("Network.enable")
        await page.send("Network.emulateNetworkConditions", offline=True, latency=0,
                        downloadThroughput=-1, uploadThroughput=-1)  # fmt: skip
        for width in (1280, 390):
            await page.show_as(width, 800)
            await page.open(path.as_uri())
            await page.evaluate("show(50)")
            shown[width] = (
                await page.evaluate("document.documentElement.scrollWidth"),
                await page.evaluate(PAINTED),
                await page.text("#moment"),
            )
        assert page.errors == []
    return shown


@needs_browser
def test_a_browser_shows_maps_and_plots_at_both_widths_without_a_network(tmp_path):
    shown = asyncio.run(_shown(tmp_path))
    assert shown == {width: (width, 7, "50 s, RETURN_HOME") for width in (1280, 390)}
