"""The benchmark of perception and the baseline that it compares with."""

import json
from functools import partial

import numpy as np
from scene import draw

from rover_common.geometry import Pose
from rover_simulator.recordings import recorder
from rover_tools.benchmarks.baseline import Baseline
from rover_tools.cli.main import main

POSE = Pose(90.0, 100.5, 0.0)


def strip(x, y):
    return (y > 98) & (y < 103)


def test_the_baseline_maps_the_ground_ahead_of_a_level_rover():
    baseline = Baseline()
    ranges, bearings = baseline.process(draw(POSE, strip), POSE)
    assert len(ranges) == len(bearings) > 100
    rows, cols = np.nonzero(baseline.navigable())
    assert {92, 93} <= set(cols.tolist())
    assert rows.min() >= 97
    assert rows.max() <= 103
    assert (cols >= 90).all()
    assert (cols <= 95).all()


def test_the_baseline_maps_nothing_when_tilted():
    baseline = Baseline()
    tilted = Pose(90.0, 100.5, 0.0, pitch=0.02)
    baseline.process(draw(tilted, strip), tilted)
    assert not baseline.navigable().any()


def test_the_benchmark_has_times_and_scores_of_both(tmp_path, monkeypatch, capsys):
    whole_drive = recorder.record_drive
    monkeypatch.setattr(recorder, "record_drive", partial(whole_drive, frames=25))
    arguments = [
        "bench",
        "perception",
        "--generated",
        "--seeds",
        "1",
        "--json",
        "--out",
        str(tmp_path),
    ]
    assert main(arguments) == 0
    result = json.loads(capsys.readouterr().out.splitlines()[0])
    assert 0 < result["core_ms_p50"] <= result["core_ms_p99"]
    assert result["reference_ms_p50"] > 0
    (course,) = result["courses"]
    assert course["frames"] == 25
    assert course["percent_mapped"] > course["reference_percent_mapped"]
    assert course["fidelity"] > 80
    assert (tmp_path / "curves.png").stat().st_size > 1000
