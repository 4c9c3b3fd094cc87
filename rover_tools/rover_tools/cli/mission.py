"""`rover mission`: a closed loop in the embedded simulator, from the start to the mission's end."""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np
from tqdm import tqdm

from rover_simulator.main import FPS, add_world_options, fps_option, world_of
from rover_simulator.simulation import START_TIME
from rover_simulator.world.world import World
from rover_tools.cli.errors import run_command
from rover_tools.evaluation.mission_result import Flight, mission_result, truth_of
from rover_tools.evaluation.results import Result, summary, write_results
from rover_tools.evaluation.strategy import SYNTAX, Strategy
from rover_tools.runner.graph import default_parameters
from rover_tools.runner.graph_watch import GraphWatch
from rover_tools.runner.run import Run, note, result_folder, running_graph

SIMULATOR = "simulator"
# The simulator waits for its answers, so that a slow machine changes nothing.
OVERRIDES: dict[str, dict[str, object]] = {"bridge_node": {"answer_deadline": 10.0}}
LOOK = 0.1  # [s] between looks at the mission
MAP_SECONDS = 5.0  # [s] for the last map to arrive
FINAL_STATES = ("DONE",)


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    options = parser("mission", __doc__ or "").parse_args(arguments)
    return run_command("mission", lambda: _mission(options))


def parser(name: str, description: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=f"rover {name}", description=description)
    add = parser.add_argument
    add_world_options(parser)
    add("--explorer", "--strategy", dest="strategy", type=Strategy.parse, metavar="NAME",
        help=f"{SYNTAX} (default: what the parameters say)")  # fmt: skip
    add("--fps", type=fps_option, default=FPS,
        help="of the camera, made 50 over a whole number (default: %(default)s)")  # fmt: skip
    add("--time-limit", type=float, default=900.0, metavar="S",
        help="give up after this simulated time [s] (default: %(default)s)")  # fmt: skip
    add("--params", type=Path, metavar="YAML", help="parameters instead of those that ship")
    add("--out", type=Path, metavar="DIR", help="result folder (default: a new one in ./results)")
    add("--json", action="store_true", help="print the result as one JSON object")
    return parser


def _mission(options: argparse.Namespace) -> None:
    world = world_of(options)
    folder = result_folder("mission", options.out)
    result = fly(
        world, options.seed, options.time_limit, folder,
        parameters=options.params, strategy=options.strategy, fps=options.fps,
    )  # fmt: skip
    print(json.dumps(result) if options.json else summary(result))
    note(
        f"{result['reason']} after {result['time']} s of simulated time, "
        f"{result['samples_collected']} of {result['samples_total']} samples; results in {folder}"
    )


def fly(
    world: World,
    seed: int,
    time_limit: float,
    folder: Path,
    *,
    parameters: Path | None = None,
    strategy: Strategy | None = None,
    fps: float = FPS,
) -> Result:
    """Run one mission to its end, score it, and write the result folder.

    A strategy that is not given is that of the parameters.
    """
    world.save(folder / "world")
    strategy = strategy or Strategy.of_parameters(parameters or default_parameters())
    overrides = OVERRIDES | {"decision_node": strategy.parameters()}
    start = time.monotonic()
    with running_graph(folder, overrides, parameters) as run:
        command = [
            sys.executable, "-m", "rover_simulator.main", "--host", run.host,
            "--port", str(run.port), "--world", str(folder / "world"), "--seed", str(seed),
            "--rate", "fast", "--fps", str(fps), "--time-limit", str(START_TIME + time_limit),
            "--progress",
        ]  # fmt: skip
        run.processes.start(SIMULATOR, command)
        done = _watch(run, time_limit)
        run.processes.end(SIMULATOR)  # only then has it said where the rover stands
        flight = read_flight(folder / "log" / f"{SIMULATOR}.log")
        mission = run.watch.mission
        stamp = 0 if mission is None else round((START_TIME + flight.time) * 1e9)
        grid = run.watch.wait_map(stamp, MAP_SECONDS)
        rocks = run.watch.rocks()
    result = mission_result(
        world, str(strategy), seed, done=done, flight=flight, grid=grid, rocks=rocks,
        recoveries=None if mission is None else mission.recoveries,
        wall_seconds=time.monotonic() - start,
    )  # fmt: skip
    write_results(folder, result, grid, flight.track, rocks, truth_of(world), world.name)
    return result


def _watch(run: Run, time_limit: float) -> bool:
    """Wait for the mission's end, with a line about it; whether it came home."""
    with tqdm(
        total=time_limit, unit="s", disable=None, bar_format="{desc} {n:.0f}/{total:.0f} s"
    ) as bar:
        while True:
            mission = run.watch.mission
            if mission is not None:
                bar.n = mission.elapsed
                bar.set_description_str(_line(run.watch))
                if mission.state_name in FINAL_STATES:
                    return True
            if run.processes.ended(SIMULATOR) == 0:
                return False
            run.processes.check()
            time.sleep(LOOK)


def _line(watch: GraphWatch) -> str:
    mission = watch.mission
    if mission is None:
        return "starting"
    return (
        f"{mission.state_name:13} {mission.samples_collected}/{mission.samples_total} samples, "
        f"home {mission.home_distance:5.1f} m"
    )


def read_flight(log: Path) -> Flight:
    """The progress lines that the simulator printed."""
    lines = [json.loads(line) for line in log.read_text().splitlines() if line.startswith("{")]
    if not lines:
        first = {"time": START_TIME, "distance": 0, "contacts": 0, "samples_left": 0}
        lines = [first | {"x": 0, "y": 0}]
    last = lines[-1]
    track = np.array([(line["x"], line["y"]) for line in lines], float)
    elapsed = last["time"] - START_TIME
    return Flight(elapsed, last["distance"], last["contacts"], last["samples_left"], track)
