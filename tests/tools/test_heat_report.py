"""The report of a heat mission: its track, its maps, its page."""

from __future__ import annotations

import asyncio
import csv
import io
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import fields
from pathlib import Path

import chromium as browser_tools
import numpy as np
import pytest
from chromium import chromium
from heat_logs import COLD, OVERLAY, SECONDS, WARM, heat_log, moment_at
from heat_runs import MAZE

from rover_common.geometry import Pose
from rover_heat.types import HeatOverlay
from rover_tools.report.heat_drawing import dots, outline, patch_of, ramp_parts
from rover_tools.report.heat_files import write_heat_files
from rover_tools.report.heat_log import (
    BLANK,
    HeatLogBuilder,
    HeatTrackPoint,
    heat_track_csv,
)
from rover_tools.report.heat_page import heat_map, heat_maze, heat_page, heat_plots, thermal_strip
from rover_tools.report.video.heat_scene import HeatSnapshot

LOGS = {
    "truth": heat_log(),
    "no truth": heat_log(truth=False, error=None),
    "no map": heat_log(grid=False),
    "no thermal": heat_log(thermal=(BLANK, BLANK)),
    "no tick": HeatLogBuilder().log("empty", None, HeatOverlay(), {}),
}
needs_browser = pytest.mark.skipif(browser_tools.executable() is None, reason="no browser")


# The track


def test_a_row_a_second_with_what_was_newest():
    rows = list(csv.DictReader(io.StringIO(heat_track_csv(LOGS["truth"].track))))
    assert [float(row["time"]) for row in rows] == list(range(SECONDS + 1))
    row = rows[50]
    assert (row["state"], row["sources_known"], row["explored"]) == ("GOAL_NAVIGATION", "1", "50.0")
    assert (float(row["x"]), float(row["distance"])) == (0.6, 1.0)
    assert (row["excess_1"], row["excess_2"], row["position_error"]) == ("0.0", "6.0", "0.01")


def test_what_is_not_known_is_an_empty_field():
    log = heat_log(truth=False, thermal=(BLANK, WARM), error=None)
    row = next(csv.DictReader(io.StringIO(heat_track_csv(log.track))))
    assert (row["excess_1"], row["excess_2"], row["position_error"]) == ("", "6.0", "")


def test_a_short_tilt_between_two_rows_is_kept():
    builder = HeatLogBuilder()
    for tick in range(21):
        pose = Pose(0.0, 0.0, 0.0, pitch=0.1 if tick == 5 else 0.0)
        builder.add(moment_at(tick / 10, pose=pose))
    tilts = [point.tilt for point in builder.log("", None, HeatOverlay(), {}).track]
    assert tilts == pytest.approx([0.0, 0.1, 0.0], abs=1e-6)


def test_the_readme_has_the_columns():
    readme = (Path(__file__).resolve().parents[2] / "rover_tools" / "README.md").read_text()
    rows = readme.split("### The track of a heat mission\n", 1)[1].split("\n#", 1)[0].splitlines()
    cells = [row.split("|")[1] for row in rows if row.startswith("| `")]
    names = [name.strip(" `") for cell in cells for name in cell.split(",")]
    assert sorted(names) == sorted(field.name for field in fields(HeatTrackPoint))


# Maps


def test_the_map_shows_what_the_mission_knows():
    root = ElementTree.fromstring(heat_map(LOGS["truth"]))
    kinds = [element.get("class") for element in root.iter()]
    for kind in ("ground", "obstacle", "hazard", "found", "launch", "start"):
        assert kind in kinds
    assert kinds.count("found") == 2
    assert not {"wall", "patch"} & set(kinds)  # what only the simulator knows


def test_the_maze_shows_truth_and_what_was_examined():
    root = ElementTree.fromstring(heat_maze(LOGS["truth"]))
    paths = {element.get("class"): element.get("d") for element in root.iter()}
    for kind in ("wall", "patch", "ramp", "flat", "face", "open-face", "found"):
        assert kind in paths
    assert paths["face"].count("M") == 2
    assert heat_maze(LOGS["no truth"]) is None


def test_truth_and_map_lie_on_each_other():
    """The west wall, in the map's frame, which is turned by a quarter."""
    root = ElementTree.fromstring(heat_maze(LOGS["truth"]))
    (wall,) = [e.get("d") for e in root.iter() if e.get("class") == "wall"]
    west = wall.split("M")[-1]  # from (0, 4) to (0, 0)
    assert west == "3.000 -1.000L-1.000 -1.000"
    group = next(element for element in root.iter() if element.get("transform"))
    assert group.get("transform") == "translate(1.0000 -1.0000) rotate(-90.000)"


def test_places_become_paths():
    assert dots(np.array([(1.0, 2.0)])) == "M1.000 -2.000h0"
    assert outline(np.array([(0, 0), (1, 0), (1, 1)])) == "M0.000 0.000L1.000 0.000L1.000 -1.000z"


def test_a_patch_is_on_its_warm_side():
    patch = patch_of(MAZE.sources[0])  # on the west wall, looking east
    assert patch[:, 0].min() == pytest.approx(0.0)
    assert patch[:, 0].max() == pytest.approx(0.2)


def test_the_parts_of_a_ramp_follow_each_other():
    up, flat, down = ramp_parts(MAZE.ramp)
    assert up[:, 1].min() == pytest.approx(2.0)
    assert flat[:, 1].min() == pytest.approx(up[:, 1].max())
    assert down[:, 1].max() == pytest.approx(2.0 + MAZE.ramp.length)


# The page


@pytest.mark.parametrize("name", LOGS)
def test_nothing_comes_from_outside(name):
    page = heat_page(LOGS[name])
    outside = page.replace('xmlns="http://www.w3.org/2000/svg"', "")
    outside = re.sub(r'src="data:image/png;base64,[^"]*"', "", outside)
    assert "://" not in outside
    assert not re.search(r"""(src|href)=|url\(|@import|\bimport\b""", outside)


def test_without_a_truth_nothing_of_it_is_shown():
    assert "The true maze" in heat_page(LOGS["truth"])
    page = heat_page(LOGS["no truth"])
    assert "The true maze" not in page
    assert "error [m]" not in page
    assert "Error of the position" not in page
    assert "No heat source was found." in heat_page(LOGS["no tick"])


def test_without_thermal_frames_there_is_no_strip():
    assert heat_page(LOGS["truth"]).count("data:image/png") == 2
    assert "data:image/png" not in heat_page(LOGS["no thermal"])


def test_a_strip_has_the_sensors_left_on_top():
    strip = thermal_strip(np.array([[8.0] + [0.0] * 7, [0.0] * 7 + [np.nan]]))
    assert strip.shape == (8, 2, 3)
    bright = strip.sum(axis=2) > 600
    assert np.argwhere(bright).tolist() == [[0, 0]]


def test_plots_reach_from_the_start_to_the_end():
    plots = {plot.title: plot for plot in heat_plots(LOGS["truth"].track)}
    explored = plots["Explored, as the mission estimates [%]"].lines[0]
    assert explored.values[40] == 40.0
    assert explored.points.endswith("1000.0,20.0")
    assert plots["Error of the position [cm]"].lines[0].values[3] == 1.0
    assert heat_plots(()) == []


def test_the_folder_holds_all_there_is_to_look_at(tmp_path):
    write_heat_files(tmp_path, LOGS["truth"], [HeatSnapshot(moment_at(0.0), None, OVERLAY)])
    assert {path.name for path in tmp_path.iterdir()} == {
        "map.pgm", "map.yaml", "map.svg", "maze.svg", "maze.yaml", "track.csv", "mission.webm",
        "report.html",
    }  # fmt: skip
    assert "<video" in (tmp_path / "report.html").read_text()


def test_without_maze_map_and_video_the_rest_is_there(tmp_path):
    write_heat_files(tmp_path, LOGS["no tick"], [])
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"map.svg", "track.csv", "report.html"}
    assert "<video" not in (tmp_path / "report.html").read_text()


async def _shown(tmp_path) -> dict[int, tuple]:
    path = tmp_path / "report.html"
    path.write_text(heat_page(LOGS["truth"]))
    shown = {}
    async with chromium() as browser:
        page = await browser.new_page()
        for width in (1280, 390):
            await page.show_as(width, 800)
            await page.open(path.as_uri())
            await page.evaluate("show(50)")
            shown[width] = (
                await page.evaluate("document.documentElement.scrollWidth"),
                await page.evaluate("document.querySelectorAll('polyline').length"),
                await page.evaluate("document.querySelector('.strip img').naturalWidth"),
                await page.text("#moment"),
            )
        assert page.errors == []
    return shown


@needs_browser
def test_a_browser_shows_it_at_both_widths(tmp_path):
    expected = (8, SECONDS + 1, "50 s, GOAL_NAVIGATION")
    assert asyncio.run(_shown(tmp_path)) == {width: (width, *expected) for width in (1280, 390)}


def test_the_warmest_pixel_of_each_column_counts():
    excess = moment_at(0.0, thermal=(COLD, WARM)).excess
    assert excess[1].tolist() == [0.0] * 6 + [6.0, 0.0]
    assert np.isnan(moment_at(0.0, thermal=(BLANK, WARM)).excess[0]).all()
