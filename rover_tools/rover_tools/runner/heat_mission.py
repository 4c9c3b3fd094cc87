"""One heat mission in the graph: robot, navigator and mission as processes."""

from __future__ import annotations

import time
from bisect import bisect_right
from collections.abc import Sequence
from pathlib import Path

from burger_simulator.truth import Truth
from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose, compose
from rover_heat.mission.chart import State
from rover_heat.types import HeatOverlay
from rover_recorder.errors import RecordingError
from rover_recorder.reader import FOLDER
from rover_tools.evaluation.heat_mission_result import HeatRun, heat_mission_result
from rover_tools.evaluation.heat_run import SLACK
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.evaluation.heat_ticks import TickLog
from rover_tools.evaluation.results import Result
from rover_tools.output import note, write_result
from rover_tools.progress import Progress
from rover_tools.report.heat_files import write_heat_report
from rover_tools.report.heat_truth import MAZE, HeatTruth
from rover_tools.runner.graph import default_parameters
from rover_tools.runner.heat_graph import KEPT, HeatProcesses, heat_graph
from rover_tools.runner.node_heat_watch import SIMULATOR, HeatWatch, Stamped, StateReport
from rover_tools.runner.page import start_page
from rover_tools.runner.recording import recording

POLL_SECONDS = 0.1  # [s] between two looks at the mission's state
ENDS = (State.DONE, State.FAILED)


def run_heat_graph(
    maze: Maze,
    seed: int,
    setup: HeatSetup,
    folder: Path,
    *,
    page: bool = False,
    open_page: bool = False,
    record: bool = False,
) -> Result:
    """Run one mission to its end, score it, and write the result folder.

    seed: of the sensors' noise. `page` serves the live page, `open_page` shows it in a browser;
    `record` records the run into the result folder, and leaves its report and video there.
    Raises GraphNotReadyError, ProcessDiedError or ResumeError.
    """
    maze.save(folder / MAZE)
    start = time.monotonic()
    with heat_graph(folder, seed, setup) as run:
        if page:
            start_page(run, default_parameters(), open_page)
        with recording(run, record, "heat"):
            run.processes.respawn(KEPT)
            run.watch.resume_simulator()
            _wait(run, setup.config.time_limit)
            run.processes.end(SIMULATOR)  # only then is the truth written whole
    truth = HeatTruth.load(folder)
    ended = measured(run.watch, truth.ticks, maze.start)
    result = heat_mission_result(maze, seed, setup, ended, time.monotonic() - start)
    result |= run.processes.remarks()
    write_result(folder, result)
    if record:
        _report(folder, f"{maze.name}, {setup.label}", truth, result)
    return result


def _report(folder: Path, title: str, truth: HeatTruth, result: Result) -> None:
    """A recording that ended too early costs the report alone."""
    try:
        write_heat_report(folder, folder / FOLDER, title, truth, result)
    except RecordingError as error:
        note(f"no report: {error}")


def measured(watch: HeatWatch, truths: Sequence[Truth], map_in_world: Pose) -> HeatRun:
    """What was reported, and what was true when it was."""
    last = watch.newest
    assert last is not None
    truths = [truth for truth in truths if stamp_of(truth) <= last.stamp]
    log = TickLog(map_in_world)
    states = [report.stamp for report in watch.reports]
    corrections, odometry = _stamps(watch.corrections), _stamps(watch.odometry)
    for truth in truths:
        stamp = stamp_of(truth)
        report = watch.reports[max(0, bisect_right(states, stamp) - 1)]
        correction = bisect_right(corrections, stamp) - 1
        placed = bisect_right(odometry, stamp) - 1
        pose = None
        if correction >= 0 and placed >= 0:
            pose = compose(watch.corrections[correction][1], watch.odometry[placed][1])
        log.add(truth, report.state, pose, report.explored)
    return HeatRun(
        last.state, last.reason, last.interrupts, HeatOverlay(sources=watch.sources), watch.grid,
        map_in_world, log.ticks(), truths[-1],
    )  # fmt: skip


def stamp_of(truth: Truth) -> int:
    """[ns] of its tick."""
    return round(truth.time * 1e9)


def _wait(run: HeatProcesses, time_limit: float) -> None:
    """Until the mission ends, or does not though its time is up; its progress is shown."""
    with Progress(time_limit, "s") as progress:
        while True:
            report = run.watch.newest
            if report is not None:
                progress.show(report.elapsed, _line(report))
                if report.state in ENDS or report.elapsed > time_limit + SLACK:
                    return
            run.processes.check()
            time.sleep(POLL_SECONDS)


def _line(report: StateReport) -> str:
    return (
        f"{report.state.name:16} {report.sources_delivered} served of {report.sources_known} known"
    )


def _stamps(stamped: Sequence[Stamped]) -> list[int]:
    return [stamp for stamp, _ in stamped]
