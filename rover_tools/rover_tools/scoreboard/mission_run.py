"""Run one mission of the scoreboard, on the machine that this is called on."""

from __future__ import annotations

import io
import time
from dataclasses import dataclass

import cv2

from rover_simulator.run import frame_steps_of
from rover_simulator.simulation import START_TIME, Simulation
from rover_simulator.world.world import World
from rover_tools.evaluation.closed_loop import Loop, LoopResult
from rover_tools.evaluation.map_files import draw_map
from rover_tools.evaluation.mission_result import (
    RESULT_KEYS,
    MissionRun,
    failed_result,
    mission_result,
    truth_of,
)
from rover_tools.evaluation.oracle.tour import oracle_tour
from rover_tools.evaluation.results import Result
from rover_tools.evaluation.strategy import Strategy
from rover_tools.scoreboard.job import Job

ROW_KEYS = (*RESULT_KEYS, "oracle_time")


@dataclass(frozen=True)
class CompletedMission:
    """A mission that ended, with its picture."""

    result: Result
    picture: bytes  # PNG


def run_job(job: Job) -> CompletedMission:
    """Run it to its end; the same job gives the same result, but for `wall_seconds`."""
    cv2.setNumThreads(1)  # each worker has one core
    start = time.monotonic()
    world = job.world()
    simulation = Simulation(world, job.seed, frame_steps_of(job.fps))
    loop = Loop(simulation, Strategy.parse(job.strategy).config())
    try:
        end = loop.run(START_TIME + job.time_limit)
    finally:
        loop.close()
    run = MissionRun(
        time=simulation.time - START_TIME,
        distance=simulation.distance,
        contacts=simulation.contacts,
        samples_left=simulation.samples_left,
        track=end.track,
    )
    result = mission_result(
        world, job.strategy, job.seed, done=end.done, run=run, grid=end.world_map,
        rocks=end.rocks, recoveries=end.decision.progress.recoveries,
        wall_seconds=time.monotonic() - start,
    )  # fmt: skip
    result["oracle_time"] = round(oracle_tour(world).seconds, 1)
    return CompletedMission(result, _picture(world, end, result))


def failed_row(job: Job, error: BaseException) -> Result:
    """The row of a mission that raised."""
    why = f"{type(error).__name__}: {error}"
    return failed_result(job.world_name, job.strategy, job.seed, why) | {"oracle_time": None}


def _picture(world: World, end: LoopResult, result: Result) -> bytes:
    title = f"{world.name}, {result['strategy']}: {result['reason']} after {result['time']} s"
    file = io.BytesIO()
    truth = truth_of(world)
    draw_map(file, end.world_map, end.track, end.rocks, truth.navigable, truth.samples, title)
    return file.getvalue()
