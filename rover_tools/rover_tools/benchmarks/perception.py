"""Time per frame and stage, and map scores, against a baseline.

Runs the core without ROS, in one thread, on recorded runs if there are any, else on drives rendered
through generated canyons. Reading the images is not measured.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ParamSpec, TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.types import CameraFrame
from rover_perception.baseline.perception import BaselinePerception
from rover_perception.config import PerceptionConfig
from rover_perception.mapping.occupancy import free_shares
from rover_perception.perception import Perception
from rover_simulator.recordings.recording import read_recording
from rover_tools.benchmarks.curve_plot import Curve, draw_curves
from rover_tools.evaluation.recordings import data_folder
from rover_tools.evaluation.results import Result, Truth, score
from rover_tools.evaluation.scoring import score_map
from rover_tools.output import note, print_result, result_folder, write_result

CONFIG = PerceptionConfig(image_lag=0)  # recorded images are of the recorded poses
SHARES = np.arange(1, 17) / 16  # of a cell, along the curves

P = ParamSpec("P")
T = TypeVar("T")


@dataclass(frozen=True)
class FrameSequence:
    """A recorded or rendered run and the truth about its world."""

    name: str
    folder: Path
    truth: Truth


def bench(generated: bool, seeds: Sequence[int], out: Path | None, as_json: bool) -> None:
    """Measure on recorded runs, or on drives through the canyons of the seeds; write and print."""
    cv2.setNumThreads(1)
    folder = result_folder("bench-perception", out)
    sequences = [] if generated else _recorded_sequences()
    timer = StageTimer()
    rows, curves = [], []
    for sequence in sequences or _generated_sequences(folder, seeds):
        row, sequence_curves = _run_sequence(sequence, timer)
        rows.append(row)
        curves += sequence_curves
    draw_curves(folder / "curves.png", curves)
    result = {**timer.summary(), "sequences": rows}
    write_result(folder, result)
    print_result(result, as_json, _table(result))
    note(f"curves and figures in {folder}")


def _recorded_sequences() -> list[FrameSequence]:
    """The runs under the data folder for which the truth is known."""
    data = data_folder()
    map_path = data / "udacity" / "calibration_images" / "map_bw.png"
    if not map_path.is_file():
        note(f"no recorded runs in {data}: generated canyons are used instead")
        return []
    folders = [log.parent for log in sorted(data.glob("*/*/robot_log.csv"))]
    return [
        FrameSequence(folder.name, folder, Truth.load(map_path, _samples_beside(folder)))
        for folder in folders
    ]


def _samples_beside(folder: Path) -> Path | None:
    candidates = (folder / "samples.csv", folder.parent / "samples.csv")
    return next((path for path in candidates if path.is_file()), None)


def _generated_sequences(folder: Path, seeds: Sequence[int]) -> list[FrameSequence]:
    from rover_simulator.recordings.recorder import record_drive  # renders: slow to import

    note(f"rendering drives through canyons {', '.join(map(str, seeds))}")
    drives = [record_drive(folder / f"canyon-{seed}", seed) for seed in seeds]
    return [
        FrameSequence(drive.folder.name, drive.folder, Truth.load(drive.truth, drive.samples))
        for drive in drives
    ]


def _run_sequence(sequence: FrameSequence, timer: StageTimer) -> tuple[Result, list[Curve]]:
    """Map one sequence with both pipelines; returns the row of the table, and both curves."""
    core, baseline = Perception(CONFIG, timer), BaselinePerception(CONFIG)
    result = None
    frames = 0
    for index, (pose, image) in enumerate(_frames_of(sequence.folder)):
        frame = CameraFrame(1 + index * 40_000_000, pose, image)
        result = timer("core", core.process, frame)
        if result.map_stamp == frame.stamp:
            timer("world_map", core.world_map)
            timer("navigation_map", core.navigation_map)
        timer("baseline", baseline.process, frame)
        frames += 1
    truth = sequence.truth.navigable
    if result is None or truth is None:
        raise ValueError(f"{sequence.folder}: nothing to score")
    of_baseline = score_map(baseline.navigable(), truth)
    row = {"sequence": sequence.name, "frames": frames}
    row |= score(core.world_map(), result.rocks, sequence.truth)
    row |= {
        "baseline_percent_mapped": round(of_baseline.percent_mapped, 2),
        "baseline_fidelity": round(of_baseline.fidelity, 2),
        "baseline_f1": round(of_baseline.f1, 2),
    }
    free = free_shares(core.evidence, 1.0)
    ours = [score_map(free >= share, truth) for share in SHARES]
    theirs = [score_map(baseline.navigable(share), truth) for share in SHARES]
    return row, [Curve(sequence.name, "ours", ours), Curve(sequence.name, "baseline", theirs)]


def _frames_of(folder: Path) -> Iterator[tuple[Pose, NDArray[np.uint8]]]:
    for frame in read_recording(folder).frames:
        picture = cv2.imread(str(frame.image_path))
        if picture is not None:
            yield frame.pose, np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)


class StageTimer:
    """A stage runner that measures each call, by the stage's name."""

    def __init__(self) -> None:
        self.seconds: dict[str, list[float]] = {}

    def __call__(self, name: str, stage: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> T:
        start = time.perf_counter()
        value = stage(*args, **kwargs)
        self.seconds.setdefault(name, []).append(time.perf_counter() - start)
        return value

    def summary(self) -> Result:
        """Median and 99th percentile [ms] of each stage."""
        result: Result = {}
        for name, seconds in self.seconds.items():
            p50, p99 = np.percentile(seconds, (50, 99)) * 1000.0
            result[f"{name}_ms_p50"] = round(float(p50), 3)
            result[f"{name}_ms_p99"] = round(float(p99), 3)
        return result


def _table(result: Result) -> str:
    lines = [f"{'[ms]':16} {'median':>8} {'p99':>8}"]
    for key in [key for key in result if key.endswith("_ms_p50")]:
        stage = key.removesuffix("_ms_p50")
        lines.append(f"{stage:16} {result[key]:8.3f} {result[stage + '_ms_p99']:8.3f}")
    lines += [
        "",
        f"{'sequence [%]':16} {'mapped':>7} {'fidelity':>8} {'F1':>6}  baseline: the same",
    ]
    for row in result["sequences"]:
        ours = f"{row['percent_mapped']:7.2f} {row['fidelity']:8.2f} {row['f1']:6.2f}"
        theirs = " ".join(
            f"{row['baseline_' + key]:6.2f}" for key in ("percent_mapped", "fidelity", "f1")
        )
        rocks = f"rocks {row['rocks_located']} of {_sum(row)}, {row['rocks_false']} unlisted"
        lines.append(f"{row['sequence']:16} {ours}  {theirs}  {rocks}")
    return "\n".join(lines)


def _sum(row: Result) -> int:
    return (row["rocks_located"] or 0) + (row["rocks_missed"] or 0)
