"""One mission in the graph: the three nodes and the embedded simulator as processes."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np

from rover_recorder.errors import RecordingError
from rover_recorder.reader import FOLDER
from rover_simulator.options import FPS
from rover_simulator.simulation import START_TIME
from rover_simulator.world.world import MAP_NAME, World
from rover_tools.evaluation.mission_result import MissionRun, mission_result, truth_of
from rover_tools.evaluation.results import Result, write_results
from rover_tools.evaluation.strategy import Strategy
from rover_tools.output import note
from rover_tools.progress import Progress
from rover_tools.report.recording_report import write_report
from rover_tools.runner.graph import NODES, default_parameters
from rover_tools.runner.node_watch import GraphWatch
from rover_tools.runner.page import start_page
from rover_tools.runner.recording import recording
from rover_tools.runner.run import Run, running_graph

SIMULATOR = "simulator"
# The simulator waits for its answers, so that a slow machine changes nothing.
OVERRIDES: dict[str, dict[str, object]] = {"bridge_node": {"answer_deadline": 10.0}}
POLL_SECONDS = 0.1  # [s] between two reads of the mission's state
MAP_SECONDS = 5.0  # [s] for the last map to arrive
FINAL_STATES = ("DONE",)


def run_mission(
    world: World,
    seed: int,
    time_limit: float,
    folder: Path,
    *,
    parameters: Path | None = None,
    strategy: Strategy | None = None,
    fps: float = FPS,
    page: bool = False,
    open_page: bool = False,
    record: bool = False,
) -> Result:
    """Run one mission to its end, score it, and write the result folder.

    time_limit [s]: of simulated time. A strategy that is not given is that of the parameters.
    `page` serves the live page, `open_page` shows it in a browser; `record` records the run
    into the result folder, and leaves its report and video there.
    Raises ParametersError, GraphNotReadyError or ProcessDiedError.
    """
    world.save(folder / "world")
    strategy = strategy or Strategy.of_parameters(parameters or default_parameters())
    overrides = OVERRIDES | strategy.parameters(folder.resolve() / "world" / MAP_NAME)
    start = time.monotonic()
    with running_graph(folder, overrides, parameters) as run:
        if page:
            start_page(run, parameters or default_parameters(), open_page)
        with recording(run, record):
            run.processes.start(SIMULATOR, _simulator_command(run, seed, fps, time_limit))
            done = _watch(run, time_limit)
            run.processes.end(SIMULATOR)  # only then has it printed its last position
            measured = read_run(folder / "log" / f"{SIMULATOR}.log")
            mission = run.watch.mission
            stamp = 0 if mission is None else round((START_TIME + measured.time) * 1e9)
            grid = run.watch.wait_map(stamp, MAP_SECONDS)
            rocks = run.watch.rocks()
    result = mission_result(
        world, str(strategy), seed, done=done, run=measured, grid=grid, rocks=rocks,
        recoveries=None if mission is None else mission.recoveries,
        wall_seconds=time.monotonic() - start,
    ) | run.processes.remarks()  # fmt: skip
    write_results(folder, result, grid, measured.track, rocks, truth_of(world), world.name)
    if record:
        _report(folder, world, result)
    return result


def _report(folder: Path, world: World, result: Result) -> None:
    """A recording that ended too early costs the report alone."""
    title = f"{world.name}, {result['strategy']}"
    try:
        write_report(folder, folder / FOLDER, truth_of(world), title, result)
    except RecordingError as error:
        note(f"no report: {error}")


def _simulator_command(run: Run, seed: int, fps: float, time_limit: float) -> list[str]:
    return [
        sys.executable, "-m", "rover_simulator.main", "--host", run.host, "--port", str(run.port),
        "--world", str(run.folder / "world"), "--seed", str(seed), "--rate", "fast",
        "--fps", str(fps), "--time-limit", str(START_TIME + time_limit), "--progress",
    ]  # fmt: skip


def _watch(run: Run, time_limit: float) -> bool:
    """Wait for the mission's end, and show its progress; whether the rover is home.

    Nodes that end meanwhile are started again.
    """
    run.processes.respawn(NODES)
    with Progress(time_limit, "s") as progress:
        while True:
            mission = run.watch.mission
            if mission is not None:
                progress.show(mission.elapsed, _line(run.watch))
                if mission.state_name in FINAL_STATES:
                    return True
            if run.processes.ended(SIMULATOR) == 0:
                return False
            run.processes.check()
            time.sleep(POLL_SECONDS)


def _line(watch: GraphWatch) -> str:
    mission = watch.mission
    if watch.failure:
        return watch.failure
    if mission is None:
        return "starting"
    return (
        f"{mission.state_name:13} {mission.samples_collected}/{mission.samples_total} samples, "
        f"home {mission.home_distance:5.1f} m"
    )


def read_run(log: Path) -> MissionRun:
    """The progress lines that the simulator printed."""
    lines = [json.loads(line) for line in log.read_text().splitlines() if line.startswith("{")]
    if not lines:
        first = {"time": START_TIME, "distance": 0, "contacts": 0, "samples_left": 0}
        lines = [first | {"x": 0, "y": 0}]
    last = lines[-1]
    track = np.array([(line["x"], line["y"]) for line in lines], float)
    elapsed = last["time"] - START_TIME
    return MissionRun(elapsed, last["distance"], last["contacts"], last["samples_left"], track)
