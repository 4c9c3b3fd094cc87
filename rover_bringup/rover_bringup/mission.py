"""`rover mission`: a closed loop in the embedded simulator, from the start to the mission's end."""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from rover_bringup.command import run_command
from rover_bringup.node_watch import GraphWatch
from rover_bringup.results import Result, Truth, score, summary, write_results
from rover_bringup.run import Run, note, result_folder, running_graph
from rover_simulator.main import add_world_options, world_of
from rover_simulator.world import World

SIMULATOR = "simulator"
# The simulator waits for its answers, so that a slow machine changes nothing.
OVERRIDES: dict[str, dict[str, object]] = {"bridge_node": {"answer_deadline": 10.0}}
LOOK = 0.1  # [s] between looks at the mission
MAP_SECONDS = 5.0  # [s] for the last map to arrive
FINAL_STATES = ("DONE",)


@dataclass(frozen=True)
class Flight:
    """What the simulator says of the run, beside what the rover believes."""

    time: float  # [s] simulated
    distance: float  # [m]
    contacts: int  # times that a wall or a rock was touched
    samples_left: int
    track: NDArray[np.float64]  # (n, 2) [m] true positions, one a second


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    options = parser("mission", __doc__ or "").parse_args(arguments)
    return run_command("mission", lambda: _mission(options))


def parser(name: str, description: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog=f"rover {name}", description=description)
    add = parser.add_argument
    add_world_options(parser)
    add("--time-limit", type=float, default=900.0, metavar="S",
        help="give up after this simulated time [s] (default: %(default)s)")  # fmt: skip
    add("--params", type=Path, metavar="YAML", help="parameters instead of those that ship")
    add("--out", type=Path, metavar="DIR", help="result folder (default: a new one in ./results)")
    add("--json", action="store_true", help="print the result as one JSON object")
    return parser


def _mission(options: argparse.Namespace) -> None:
    world = world_of(options)
    folder = result_folder("mission", options.out)
    result = fly(world, options.seed, options.time_limit, folder, options.params)
    print(json.dumps(result) if options.json else summary(result))
    note(
        f"{result['reason']} after {result['time']} s of simulated time, "
        f"{result['samples_collected']} of {result['samples_total']} samples; results in {folder}"
    )


def fly(
    world: World, seed: int, time_limit: float, folder: Path, parameters: Path | None = None
) -> Result:
    """Run one mission to its end, score it, and write the result folder."""
    world.save(folder / "world")
    start = time.monotonic()
    with running_graph(folder, OVERRIDES, parameters) as run:
        command = [
            sys.executable, "-m", "rover_simulator.main",
            "--host", run.host, "--port", str(run.port), "--world", str(folder / "world"),
            "--seed", str(seed), "--rate", "fast", "--time-limit", str(time_limit), "--progress",
        ]  # fmt: skip
        run.processes.start(SIMULATOR, command)
        done = _watch(run, time_limit)
        run.processes.end(SIMULATOR)  # only then has it said where the rover stands
        flight = read_flight(folder / "log" / f"{SIMULATOR}.log")
        mission = run.watch.mission
        stamp = 0 if mission is None else round(flight.time * 1e9)
        grid = run.watch.wait_map(stamp, MAP_SECONDS)
        rocks = run.watch.rocks()
    truth = Truth(world.navigable, world.samples)
    scores = score(grid, rocks, truth)
    home = np.hypot(*(flight.track[-1] - (world.start.x, world.start.y)))
    result = {
        "done": done,
        "reason": "home" if done else "the time is up",
        "time": round(flight.time, 1),
        **scores,
        "samples_collected": len(world.samples) - flight.samples_left,
        "samples_total": len(world.samples),
        "home_distance": round(float(home), 2),
        "distance": round(flight.distance, 1),
        "contacts": flight.contacts,
        "recoveries": None if mission is None else mission.recoveries,
        "world": world.name,
        "seed": seed,
        "wall_seconds": round(time.monotonic() - start, 1),
    }
    write_results(folder, result, grid, flight.track, rocks, truth, world.name)
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
        lines = [{"time": 0, "distance": 0, "contacts": 0, "samples_left": 0, "x": 0, "y": 0}]
    last = lines[-1]
    track = np.array([(line["x"], line["y"]) for line in lines], float)
    return Flight(last["time"], last["distance"], last["contacts"], last["samples_left"], track)
