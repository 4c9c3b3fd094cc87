"""A mission over time: what is kept of its frames."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import fields
from pathlib import Path

import pytest
from mission_logs import TRUTH, grid_of, mission_log, moment_at

from rover_common.geometry import Pose
from rover_tools.evaluation.results import Truth
from rover_tools.report.mission_log import LogBuilder, TrackPoint, tilt_of, track_csv


def test_a_point_a_second_and_one_at_the_end():
    times = [point.time for point in mission_log(seconds=4.5).track]
    assert times == [0.0, 1.0, 2.0, 3.0, 4.0, 4.5]


@pytest.mark.parametrize("period", [0.08, 0.3, 0.7])
def test_points_do_not_drift_from_the_seconds(period):
    builder = LogBuilder(Truth())
    for frame in range(int(50 / period)):
        builder.add(moment_at(frame * period), lambda: None)
    track = builder.log("", None, (), {}).track
    assert all(
        point.time - second < period for second, point in zip(range(49), track, strict=False)
    )


def test_every_change_of_state_is_kept_with_its_reason_and_place():
    changes = mission_log().changes
    assert [(c.time, c.state, c.reason, c.x) for c in changes] == [
        (0.0, "FORWARD", "drives to a frontier", 45.0),
        (pytest.approx(40.1), "RETURN_HOME", "nothing is left", pytest.approx(84.9)),
    ]


def test_a_short_tilt_between_two_points_is_kept():
    builder = LogBuilder(Truth())
    for frame in range(21):
        tilted = Pose(50.0, 75.0, 0.0, roll=0.3 if frame == 5 else 0.0)
        builder.add(moment_at(frame / 10, pose=tilted), lambda: None)
    tilts = [point.tilt for point in builder.log("", None, (), {}).track]
    assert tilts == pytest.approx([0.0, 0.3, 0.0])


def test_tilt_joins_roll_and_pitch():
    assert tilt_of(Pose(0, 0, 1.0, pitch=0.2)) == pytest.approx(0.2)
    assert tilt_of(Pose(0, 0, 0, pitch=math.pi / 2, roll=0.4)) == pytest.approx(math.pi / 2)


def test_the_map_is_asked_for_once_a_second_only():
    asked = []
    builder = LogBuilder(TRUTH)
    for frame in range(100):
        builder.add(moment_at(frame / 10), lambda: asked.append(1))
    assert len(asked) == 10


def test_progress_of_the_map_is_scored_where_there_is_a_truth():
    last = mission_log().track[-1]
    assert (last.mapped_area, last.percent_mapped, last.fidelity) == (1800.0, 75.0, 100.0)
    last = mission_log(Truth()).track[-1]
    assert (last.mapped_area, last.percent_mapped, last.fidelity) == (1800.0, None, None)


def test_the_last_point_has_the_last_map():
    builder = LogBuilder(TRUTH)
    for time in (0.0, 1.0):
        builder.add(moment_at(time), lambda: None)
    log = builder.log("", grid_of(TRUTH.navigable), (), {})
    assert [point.time for point in log.track] == [0.0, 1.0]
    assert log.track[-1].percent_mapped == 100.0


def test_a_mission_without_a_frame_has_an_empty_log():
    log = LogBuilder(TRUTH).log("", None, (), {})
    assert (log.track, log.changes) == ((), ())


def test_track_csv_has_a_heading_and_empty_fields_for_what_is_not_known():
    rows = list(csv.DictReader(io.StringIO(track_csv(mission_log(Truth()).track))))
    assert len(rows) == 81
    assert rows[50]["state"] == "RETURN_HOME"
    assert (float(rows[50]["x"]), float(rows[50]["home_distance"])) == (75.0, 30.0)
    assert rows[50]["percent_mapped"] == ""


def test_the_readme_has_the_columns():
    readme = (Path(__file__).resolve().parents[2] / "rover_tools" / "README.md").read_text()
    rows = readme.split("### The track\n", 1)[1].split("\n#", 1)[0].splitlines()
    cells = [row.split("|")[1] for row in rows if row.startswith("| `")]
    names = [name.strip(" `") for cell in cells for name in cell.split(",")]
    assert sorted(names) == sorted(field.name for field in fields(TrackPoint))
