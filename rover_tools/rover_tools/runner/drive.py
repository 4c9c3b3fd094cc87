"""Drive by the keys of a terminal: a graph that runs, or one with the embedded simulator."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

from rover_simulator.simulation import START_TIME
from rover_simulator.world.world import World
from rover_tools.evaluation.mission_result import mission_result, truth_of
from rover_tools.evaluation.results import Result, write_results
from rover_tools.output import note
from rover_tools.runner.graph import default_parameters
from rover_tools.runner.mission import MAP_SECONDS, SIMULATOR, read_run
from rover_tools.runner.node_teleop import Teleop
from rover_tools.runner.page import start_page
from rover_tools.runner.recording import recording
from rover_tools.runner.run import Run, started_graph
from rover_tools.teleop.keys import HELP, Key, KeyDriver, keys_of
from rover_tools.teleop.terminal import Terminal

NODES = ("bridge_node", "perception_node")  # nobody but the keys drives
PERIOD = 0.05  # [s] between two velocities, well within the bridge's timeout


def drive_graph(
    domain_id: int, terminal: Terminal, check: Callable[[], None] = lambda: None
) -> None:
    """Drive the graph of a domain until the key that ends it; `check` is called meanwhile."""
    driver = KeyDriver()
    note(HELP)
    with Teleop(domain_id) as teleop, terminal:
        while True:
            for key in keys_of(terminal.read(PERIOD)):
                if key is Key.END:
                    print(file=sys.stderr)
                    return
                driver.press(key)
            wanted = driver.velocity
            teleop.drive(wanted)
            _show(f"{teleop.speed:5.2f} m/s of {wanted.linear:4.1f}, turn {wanted.angular:5.2f} "
                  f"rad/s, driver: {teleop.driver or 'no bridge yet'}")  # fmt: skip
            check()


def drive_world(
    world: World,
    seed: int,
    folder: Path,
    terminal: Terminal,
    *,
    fps: float,
    parameters: Path | None,
    page: bool,
    open_page: bool,
    record: bool,
) -> Result:
    """Drive in the embedded simulator, in real time, until the key that ends it; score the map.

    `record` records the drive into the folder. Raises DomainError, ProcessDiedError or PageError.
    """
    world.save(folder / "world")
    start = time.monotonic()
    with started_graph(folder, None, parameters, NODES) as run:
        if page:
            start_page(run, parameters or default_parameters(), open_page)
        with recording(run, record, "drive"):
            run.processes.start(SIMULATOR, _simulator_command(run, seed, fps))
            drive_graph(run.domain_id, terminal, run.processes.check)
            run.processes.end(SIMULATOR)
            driven = read_run(folder / "log" / f"{SIMULATOR}.log")
            grid = run.watch.wait_map(round((START_TIME + driven.time) * 1e9), MAP_SECONDS)
            rocks = run.watch.rocks()
    result = mission_result(
        world, "by hand", seed, done=False, run=driven, grid=grid, rocks=rocks, recoveries=None,
        wall_seconds=time.monotonic() - start,
    )  # fmt: skip
    result["reason"] = "ended by hand"
    write_results(folder, result, grid, driven.track, rocks, truth_of(world), world.name)
    return result


def _simulator_command(run: Run, seed: int, fps: float) -> list[str]:
    return [
        sys.executable, "-m", "rover_simulator.main", "--host", run.host, "--port", str(run.port),
        "--world", str(run.folder / "world"), "--seed", str(seed), "--fps", str(fps),
        "--progress",
    ]  # fmt: skip


def _show(text: str) -> None:
    """On the line of the one before."""
    print(f"\r{text}\x1b[K", end="", file=sys.stderr, flush=True)
