"""Run one heat mission, on the machine that this is called on."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import cv2

from rover_tools.evaluation.heat_loop import HeatStep
from rover_tools.evaluation.heat_mission_result import (
    HEAT_RESULT_KEYS,
    failed_heat_result,
    heat_mission_result,
)
from rover_tools.evaluation.heat_run import run_heat_mission
from rover_tools.evaluation.results import Result
from rover_tools.output import write_result
from rover_tools.progress import Progress
from rover_tools.scoreboard.heat_job import HeatJob
from rover_tools.scoreboard.missions import CompletedMission

MAZE = "maze.yaml"
HEAT_ROW_KEYS = (*HEAT_RESULT_KEYS, "times_real_time")


def run_heat_job(
    job: HeatJob, watch: Callable[[HeatStep], object] = lambda _: None
) -> CompletedMission:
    """Run it to its end; the same job gives the same result, but for the time that it takes.

    `watch` is called after every tick.
    """
    cv2.setNumThreads(1)  # each worker has one core
    start, cpu = time.monotonic(), time.process_time()
    maze, config = job.world(), job.setup.config
    run = run_heat_mission(maze, job.seed, job.setup, lambda _, step: watch(step))
    cpu = time.process_time() - cpu
    result = heat_mission_result(
        maze, job.seed, job.setup.label, run, time_limit=config.time_limit,
        stand_off=config.stand_off, wall_seconds=time.monotonic() - start,
    )  # fmt: skip
    result["times_real_time"] = round(run.time / cpu, 1)
    return CompletedMission(result, {})


def complete(job: HeatJob, folder: Path) -> Result:
    """Run it here with its progress shown, and write the result folder; returns the result."""
    job.world().save(folder / MAZE)
    with Progress(job.setup.config.time_limit, "s") as progress:

        def show(step: HeatStep) -> None:
            known = step.decision.progress
            text = (
                f"{step.decision.state.name:16} {known.sources_delivered} delivered of "
                f"{known.sources_known} known"
            )
            progress.show(known.elapsed, text)

        completed = run_heat_job(job, show)
    write_result(folder, completed.result)
    return completed.result


def failed_heat_row(job: HeatJob, error: BaseException) -> Result:
    """The row of a mission that raised."""
    why = f"{type(error).__name__}: {error}"
    row = failed_heat_result(job.world_name, job.seed, job.setup.label, why)
    return row | {"times_real_time": None}
