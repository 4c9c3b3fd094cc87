"""Run one of the rover's missions, on the machine that this is called on."""

from __future__ import annotations

import time
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2

from rover_decision.types import Decision
from rover_simulator.run import frame_steps_of
from rover_simulator.simulation import START_TIME, Simulation
from rover_simulator.world.world import MAP_NAME, World
from rover_tools.evaluation.closed_loop import Loop, LoopResult
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
from rover_tools.report.mission_log import LogBuilder, Moment, track_csv
from rover_tools.report.mission_page import mission_map, mission_page
from rover_tools.scoreboard.job import Job
from rover_tools.scoreboard.missions import CompletedMission, Files

ROW_KEYS = (*RESULT_KEYS, "oracle_time")


def run_job(job: Job) -> CompletedMission:
    """Run it to its end; the same job gives the same result, but for `wall_seconds`."""
    cv2.setNumThreads(1)  # each worker has one core
    start = time.monotonic()
    world = job.world()
    simulation = Simulation(world, job.seed, frame_steps_of(job.fps))
    loop = _loop(simulation, world, Strategy.parse(job.strategy))
    log = LogBuilder(truth_of(world))
    try:
        end = loop.run(START_TIME + job.time_limit, lambda decision: _add(log, loop, decision))
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
    return CompletedMission(result, _files(world, end, result, log))


def failed_row(job: Job, error: BaseException) -> Result:
    """The row of a mission that raised."""
    why = f"{type(error).__name__}: {error}"
    return failed_result(job.world_name, job.strategy, job.seed, why) | {"oracle_time": None}


def _loop(simulation: Simulation, world: World, strategy: Strategy) -> Loop:
    with TemporaryDirectory() as folder:  # the truth is a parameter of decision: a file
        world.save(Path(folder))
        config = strategy.config(Path(folder) / MAP_NAME)
        return Loop(simulation, config, strategy.perception())


def _add(log: LogBuilder, loop: Loop, decision: Decision) -> None:
    frame, progress = loop.frame, decision.progress
    assert frame is not None
    moment = Moment(
        progress.elapsed,
        frame.pose,
        frame.speed,
        decision.state.name,
        decision.reason,
        progress.samples_collected,
        progress.home_distance,
        progress.distance,
        progress.explored,
    )
    log.add(moment, loop.perception.world_map)


def _files(world: World, end: LoopResult, result: Result, builder: LogBuilder) -> Files:
    log = builder.log(f"{world.name}, {result['strategy']}", end.world_map, end.rocks, result)
    return {
        ".svg": mission_map(log).encode(),
        ".csv": track_csv(log.track).encode(),
        ".html": mission_page(log).encode(),
    }
