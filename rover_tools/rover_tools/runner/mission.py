"""One mission in the graph: the three nodes and the embedded simulator as processes."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from rover_common.types import GridMap
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
from rover_tools.runner import mission_state
from rover_tools.runner.graph import NODES, default_parameters
from rover_tools.runner.mission_state import MissionSetup
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
    resume: bool = False,
) -> Result:
    """Run one mission to its end, score it, and write the result folder.

    time_limit [s]: of simulated time; strategy: instead of that of the parameters; page: serve the
    live page; open_page: show it in a browser; record: leave report and video as well; resume: the
    mission that was interrupted in the folder goes on.
    Raises ParametersError, GraphNotReadyError or ProcessDiedError.
    """
    world.save(folder / "world")
    strategy = strategy or Strategy.of_parameters(parameters or default_parameters())
    setup = MissionSetup.of(seed, time_limit, fps, strategy, parameters)
    mission_state.prepare(folder, setup, resume)
    start = time.monotonic()
    with running_graph(folder, _overrides(folder, strategy), parameters) as run:
        if page:
            start_page(run, parameters or default_parameters(), open_page)
        with recording(run, record):
            done, measured, grid = _drive(run, seed, fps, time_limit)
            mission, rocks = run.watch.mission, run.watch.rocks()
            _remark_on_plans(run)
    result = mission_result(
        world, str(strategy), seed, done=done, run=measured, grid=grid, rocks=rocks,
        recoveries=mission and mission.recoveries, wall_seconds=time.monotonic() - start,
    ) | run.processes.remarks()  # fmt: skip
    write_results(folder, result, grid, measured.track, rocks, truth_of(world), world.name)
    mission_state.end(folder)
    if record:
        _report(folder, world, result)
    return result


def _drive(
    run: Run, seed: int, fps: float, time_limit: float
) -> tuple[bool, MissionRun, GridMap | None]:
    """Whether the mission came to its end, and to what; nodes that end are started again."""
    run.processes.respawn(NODES)
    run.processes.start(SIMULATOR, simulator_command(run, seed, fps, time_limit))
    done = watch_mission(run, time_limit)
    return done, *end_and_measure(run)


def _remark_on_plans(run: Run) -> None:
    """A mission whose planner fails holds and goes home, which looks like a success."""
    failed = run.watch.counts().get("decision_node", {}).get("plans_failed", 0)
    if failed:
        log = run.folder / "log" / "decision_node.log"
        run.processes.remark(f"decision_node: {failed} plans failed; {log} tells why")


def end_and_measure(run: Run) -> tuple[MissionRun, GridMap | None]:
    """What the simulator says at its end, and the map of its last frame."""
    run.processes.end(SIMULATOR)  # only then has it printed its last position
    measured = read_run(*mission_state.logs_of(run.folder, SIMULATOR))
    stamp = 0 if run.watch.mission is None else round((START_TIME + measured.time) * 1e9)
    return measured, run.watch.wait_map(stamp, MAP_SECONDS)


def _overrides(folder: Path, strategy: Strategy) -> dict[str, dict[str, object]]:
    """Parameters of the nodes, by their names."""
    parts = (
        OVERRIDES,
        strategy.parameters(folder.resolve() / "world" / MAP_NAME),
        mission_state.state_parameters(folder),
    )
    return {node: {k: v for part in parts for k, v in part.get(node, {}).items()} for node in NODES}


def _report(folder: Path, world: World, result: Result) -> None:
    """A recording that ended too early costs the report alone."""
    title = f"{world.name}, {result['strategy']}"
    try:
        write_report(folder, folder / FOLDER, truth_of(world), title, result)
    except RecordingError as error:
        note(f"no report: {error}")


def simulator_command(
    run: Run, seed: int, fps: float, time_limit: float, rate: str = "fast"
) -> list[str]:
    """Of the embedded simulator; rate: as `rover sim` has it."""
    return [
        sys.executable, "-m", "rover_simulator.main", "--host", run.host, "--port", str(run.port),
        "--world", str(run.folder / "world"), "--seed", str(seed), "--rate", rate,
        "--fps", str(fps), "--time-limit", str(START_TIME + time_limit), "--progress",
        "--state", str(run.folder / mission_state.STATE / mission_state.SIMULATION),
    ]  # fmt: skip


def watch_mission(run: Run, time_limit: float, tick: Callable[[], None] = lambda: None) -> bool:
    """Wait for the mission's end, and show its progress; whether the rover is home.

    tick: called again and again meanwhile.
    """
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
            tick()
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


def read_run(*logs: Path) -> MissionRun:
    """The progress lines that the simulator printed, in all parts of the mission."""
    texts = "\n".join(log.read_text() for log in logs)
    lines = [json.loads(line) for line in texts.splitlines() if line.startswith("{")]
    if not lines:
        first = {"time": START_TIME, "distance": 0, "contacts": 0, "samples_left": 0}
        lines = [first | {"x": 0, "y": 0}]
    last = lines[-1]
    track = np.array([(line["x"], line["y"]) for line in lines], float)
    elapsed = last["time"] - START_TIME
    return MissionRun(elapsed, last["distance"], last["contacts"], last["samples_left"], track)
