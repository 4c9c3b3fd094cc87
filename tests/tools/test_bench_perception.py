"""The benchmark of perception and its baseline."""

import json
from functools import partial

from scene import draw

from rover_common.geometry import Pose
from rover_common.types import CameraFrame
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception
from rover_simulator.recordings import recorder
from rover_tools.benchmarks import perception as bench_perception
from rover_tools.cli.main import main

POSE = Pose(90.0, 100.5, 0.0)
STAGES = [
    "validation", "projection", "rock_mask", "rock_detection", "ground_columns", "evidence",
    "rock_tracks", "free_scan", "nav_polar", "rock_polar",
]  # fmt: skip


def strip(x, y):
    return (y > 98) & (y < 103)


def test_the_timer_measures_each_stage_of_the_pipeline_once_per_frame():
    timer = bench_perception.StageTimer()
    core = Perception(PerceptionConfig(image_lag=0), timer)
    for stamp in (1, 2):
        core.process(CameraFrame(stamp, POSE, draw(POSE, strip)))
    assert list(timer.seconds) == STAGES
    assert {len(seconds) for seconds in timer.seconds.values()} == {2}


def test_the_benchmark_reports_times_and_scores_of_both(tmp_path, monkeypatch, capsys):
    whole_drive = recorder.record_drive
    monkeypatch.setattr(recorder, "record_drive", partial(whole_drive, frames=25))
    arguments = ["--generated", "--seeds", "1", "--json", "--out", str(tmp_path)]
    assert main(["bench", "perception", *arguments]) == 0
    result = json.loads(capsys.readouterr().out.splitlines()[0])
    for stage in (*STAGES, "core", "world_map", "navigation_map", "baseline"):
        assert 0 < result[f"{stage}_ms_p50"] <= result[f"{stage}_ms_p99"]
    (sequence,) = result["sequences"]
    assert sequence["frames"] == 25
    assert sequence["percent_mapped"] > sequence["baseline_percent_mapped"]
    assert sequence["fidelity"] > 80
    assert (tmp_path / "curves.png").stat().st_size > 1000
