"""Time per frame and map scores of perception, beside those of a baseline.

Runs the core without ROS, in one thread, on recorded runs where there are some, else on drives
rendered through generated canyons. Reading the images is not counted.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.types import CameraFrame
from rover_perception.camera.ground_projection import View
from rover_perception.camera.segmentation import ground_columns, rock_mask
from rover_perception.config import PerceptionConfig
from rover_perception.mapping.evidence import EvidenceGrid
from rover_perception.mapping.occupancy import shares_of
from rover_perception.mapping.scan import free_scan
from rover_perception.perception import Perception
from rover_perception.tracking.rock_detection import detect_rocks
from rover_simulator.recordings.recording import read_recording
from rover_tools.benchmarks.baseline import Baseline
from rover_tools.benchmarks.curve_plot import Curve, draw_curves
from rover_tools.evaluation.recordings import data_folder
from rover_tools.evaluation.results import Result, Truth, score
from rover_tools.evaluation.scoring import MapScore, score_map
from rover_tools.output import note, print_result, result_folder, write_result

CONFIG = PerceptionConfig(image_lag=0)  # recorded images are of the recorded poses
SHARES = np.arange(1, 17) / 16  # of a cell, along the curves


@dataclass(frozen=True)
class Course:
    """A recorded or rendered run and what is true of its world."""

    name: str
    folder: Path
    truth: Truth


def bench(generated: bool, seeds: Sequence[int], out: Path | None, as_json: bool) -> None:
    """Measure on recorded runs, or on drives through the canyons of the seeds; write and print."""
    cv2.setNumThreads(1)
    folder = result_folder("bench-perception", out)
    courses = [] if generated else _recorded_courses()
    times: dict[str, list[float]] = {}
    rows, curves = [], []
    for course in courses or _generated_courses(folder, seeds):
        row, ours, reference = _run_course(course, times)
        rows.append(row)
        curves += [Curve(course.name, "ours", ours), Curve(course.name, "reference", reference)]
    draw_curves(folder / "curves.png", curves)
    result = {**_summary_of(times), "courses": rows}
    write_result(folder, result)
    print_result(result, as_json, _table(result))
    note(f"curves and figures in {folder}")


def _recorded_courses() -> list[Course]:
    """The runs under the data folder for which the truth is known."""
    data = data_folder()
    map_path = data / "udacity" / "calibration_images" / "map_bw.png"
    if not map_path.is_file():
        note(f"no recorded runs in {data}: generated canyons are used instead")
        return []
    logs = sorted(data.glob("*/*/robot_log.csv"))
    return [
        Course(log.parent.name, log.parent, Truth.load(map_path, _samples_beside(log.parent)))
        for log in logs
    ]


def _samples_beside(folder: Path) -> Path | None:
    candidates = (folder / "samples.csv", folder.parent / "samples.csv")
    return next((path for path in candidates if path.is_file()), None)


def _generated_courses(folder: Path, seeds: Sequence[int]) -> list[Course]:
    from rover_simulator.recordings.recorder import record_drive  # renders: slow to import

    note(f"rendering drives through canyons {', '.join(map(str, seeds))}")
    drives = [record_drive(folder / f"canyon-{seed}", seed) for seed in seeds]
    return [
        Course(drive.folder.name, drive.folder, Truth.load(drive.truth, drive.samples))
        for drive in drives
    ]


def _run_course(
    course: Course, times: dict[str, list[float]]
) -> tuple[Result, list[MapScore], list[MapScore]]:
    """Map one course by both; returns the row of the table, and both curves."""
    core, reference = Perception(CONFIG), Baseline()
    stages = _Stages(times)
    percept = None
    frames = 0
    for index, (pose, image) in enumerate(_frames_of(course.folder)):
        frame = CameraFrame(1 + index * 40_000_000, pose, image)
        percept = stages.timed("core", core.process, frame)
        stages.timed("reference", reference.process, image, pose)
        stages.run(image, pose)
        frames += 1
    truth = course.truth.navigable
    if percept is None or truth is None:
        raise ValueError(f"{course.folder}: nothing to score")
    shares, *_ = shares_of(core.evidence, 1.0)
    theirs = score_map(reference.navigable(), truth)
    row = {"course": course.name, "frames": frames}
    row |= score(core.world_map(), percept.rocks, course.truth)
    row |= {
        "reference_percent_mapped": round(theirs.percent_mapped, 2),
        "reference_fidelity": round(theirs.fidelity, 2),
        "reference_f1": round(theirs.f1, 2),
    }
    return (
        row,
        [score_map(shares >= share, truth) for share in SHARES],
        [score_map(reference.navigable(share), truth) for share in SHARES],
    )


def _frames_of(folder: Path) -> Iterator[tuple[Pose, NDArray[np.uint8]]]:
    for frame in read_recording(folder).frames:
        picture = cv2.imread(str(frame.image_path))
        if picture is not None:
            yield frame.pose, np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)


class _Stages:
    """Times [s] by stage; runs each of the core's stages by itself on the same frame."""

    def __init__(self, times: dict[str, list[float]]) -> None:
        self._times = times
        self._grid = EvidenceGrid(Perception(CONFIG).evidence.geometry, CONFIG.max_range)

    def timed(self, stage: str, function: Callable[..., Any], *arguments: Any) -> Any:
        start = time.perf_counter()
        value = function(*arguments)
        self._times.setdefault(stage, []).append(time.perf_counter() - start)
        return value

    def run(self, image: NDArray[np.uint8], pose: Pose) -> None:
        view = self.timed("view", View.of, ROVER_CAMERA, pose)
        if not view.usable:
            return
        mask = self.timed("rock_mask", rock_mask, image, view)
        self.timed("rocks", detect_rocks, image, mask, view, pose)
        columns = self.timed("classes", ground_columns, image, mask, view)
        self.timed("evidence", self._grid.add, view, columns, pose)
        self.timed("scan", free_scan, view, columns, CONFIG.max_range)


def _summary_of(times: dict[str, list[float]]) -> Result:
    result: Result = {}
    for stage, seconds in times.items():
        p50, p99 = np.percentile(seconds, (50, 99)) * 1000.0
        result |= {f"{stage}_ms_p50": round(float(p50), 3), f"{stage}_ms_p99": round(float(p99), 3)}
    return result


def _table(result: Result) -> str:
    lines = [f"{'[ms]':12} {'median':>8} {'p99':>8}"]
    for key in [key for key in result if key.endswith("_ms_p50")]:
        stage = key.removesuffix("_ms_p50")
        lines.append(f"{stage:12} {result[key]:8.3f} {result[stage + '_ms_p99']:8.3f}")
    lines += ["", f"{'course [%]':16} {'mapped':>7} {'fidelity':>8} {'F1':>6}  baseline"]
    for row in result["courses"]:
        ours = f"{row['percent_mapped']:7.2f} {row['fidelity']:8.2f} {row['f1']:6.2f}"
        theirs = " ".join(
            f"{row['reference_' + key]:6.2f}" for key in ("percent_mapped", "fidelity", "f1")
        )
        rocks = f"rocks {row['rocks_located']} of {_sum(row)}, {row['rocks_false']} unlisted"
        lines.append(f"{row['course']:16} {ours}  {theirs}  {rocks}")
    return "\n".join(lines)


def _sum(row: Result) -> int:
    return (row["rocks_located"] or 0) + (row["rocks_missed"] or 0)
