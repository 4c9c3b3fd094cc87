"""The graph with the embedded simulator and the live page, all as processes."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rover_simulator.world.generator import generate_world
from rover_tools.runner.graph import default_parameters
from rover_tools.runner.mission import OVERRIDES, SIMULATOR
from rover_tools.runner.page import start_page
from rover_tools.runner.run import Run, running_graph

FPS = 12.5
TIME_LIMIT = 36000.0  # [s] of simulated time: the mission's end, not the simulator's, ends a test


@dataclass(frozen=True)
class Watched:
    run: Run
    address: str  # of the page


@contextmanager
def watched_graph(folder: Path, seed: int, size: float, rate: str) -> Iterator[Watched]:
    """A mission in a generated canyon, at so many times real time or `fast`."""
    generate_world(seed, size).save(folder / "world")
    with running_graph(folder, OVERRIDES) as run:
        address = start_page(run, default_parameters(), open_page=False)
        command = [
            sys.executable, "-m", "rover_simulator.main", "--host", run.host,
            "--port", str(run.port), "--world", str(folder / "world"), "--seed", str(seed),
            "--rate", rate, "--fps", str(FPS), "--time-limit", str(TIME_LIMIT),
        ]  # fmt: skip
        run.processes.start(SIMULATOR, command)
        yield Watched(run, address)
