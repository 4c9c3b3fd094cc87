"""Run one heat mission, on the machine that this is called on."""

from __future__ import annotations

import resource
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np

from rover_tools.evaluation.heat_loop import HeatLoop, HeatStep
from rover_tools.evaluation.heat_mission_result import (
    HEAT_RESULT_KEYS,
    failed_heat_result,
    heat_mission_result,
)
from rover_tools.evaluation.heat_run import run_heat_mission
from rover_tools.evaluation.results import Result
from rover_tools.output import write_result
from rover_tools.progress import Progress
from rover_tools.report.heat_files import write_heat_files
from rover_tools.report.heat_log import HeatLog, heat_track_csv
from rover_tools.report.heat_page import heat_map, heat_page
from rover_tools.report.heat_steps import StepWatch
from rover_tools.scoreboard.heat_job import HeatJob
from rover_tools.scoreboard.missions import CompletedMission

COSTS = ("times_real_time", "ticks", "tick_ms_p99", "tick_ms_max", "memory_mb")
HEAT_ROW_KEYS = (*HEAT_RESULT_KEYS, *COSTS)
Watch = Callable[[HeatLoop, HeatStep], object]


def run_heat_job(job: HeatJob) -> CompletedMission:
    """Run it to its end; the same job gives the same result, but for the time that it takes."""
    cv2.setNumThreads(1)  # each worker has one core
    watch = StepWatch(job.world().start)
    log = _run(job, watch, watch)
    files = {
        ".svg": heat_map(log).encode(),
        ".csv": heat_track_csv(log.track).encode(),
        ".html": heat_page(log).encode(),
    }
    return CompletedMission(log.result, files)


def complete(job: HeatJob, folder: Path) -> Result:
    """Run it here with its progress shown, and write the result folder; returns the result."""
    watch = StepWatch(job.world().start)
    with Progress(job.setup.config.time_limit, "s") as progress:

        def show(loop: HeatLoop, step: HeatStep) -> None:
            watch(loop, step)
            known = step.decision.progress
            text = (
                f"{step.decision.state.name:16} {known.sources_delivered} served of "
                f"{known.sources_known} known"
            )
            progress.show(known.elapsed, text)

        log = _run(job, watch, show)
    write_result(folder, log.result)
    write_heat_files(folder, log, watch.snapshots)
    return log.result


def failed_heat_row(job: HeatJob, error: BaseException) -> Result:
    """The row of a mission that raised."""
    why = f"{type(error).__name__}: {error}"
    row = failed_heat_result(job.world_name, job.seed, job.setup.label, why)
    return row | dict.fromkeys(COSTS)


def _run(job: HeatJob, watch: StepWatch, on_step: Watch) -> HeatLog:
    """Run it; returns what its report shows."""
    start, cpu = time.monotonic(), time.process_time()
    maze, ticks = job.world(), list[float]()

    def see(loop: HeatLoop, step: HeatStep) -> None:
        ticks.append(step.cpu_seconds)
        on_step(loop, step)

    run = run_heat_mission(maze, job.seed, job.setup, see)
    cpu = time.process_time() - cpu
    seconds = time.monotonic() - start
    result = heat_mission_result(maze, job.seed, job.setup, run, seconds)
    result["times_real_time"] = round(run.time / cpu, 1)
    result["ticks"] = len(ticks)
    result["tick_ms_p99"] = round(1e3 * float(np.percentile(ticks, 99)), 2)
    result["tick_ms_max"] = round(1e3 * max(ticks), 2)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # [KiB] of this process so far
    result["memory_mb"] = round(peak / 1024.0, 1)
    watch.end(run.grid, run.overlay)
    return watch.log.log(
        f"{maze.name}, {job.setup.label}", run.grid, watch.with_faces(run.overlay), result, maze,
        run.map_in_world, run.truth.launches,
    )  # fmt: skip
