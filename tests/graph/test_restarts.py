"""A node that is killed and started again knows the mission, and so do all of them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from waiting import holds

from rover_common.map_encoding import navigable_cells
from rover_common.ros import conversions
from rover_simulator.simulation import START_TIME
from rover_simulator.world.generator import generate_world
from rover_tools.runner import mission_state
from rover_tools.runner.graph import HOST, NODES, default_parameters, node_command
from rover_tools.runner.mission import OVERRIDES, SIMULATOR, read_run
from rover_tools.runner.run import Run, running_graph

SEED, SIZE, FPS = 11, 0.2, 10.0
WAIT = 60.0  # [s]
DRIVEN = 4.0  # [s] of mission time between two kills


class Driven:
    """The graph as processes, and a simulator that drives with it."""

    def __init__(self, run: Run, folder: Path) -> None:
        self.run, self._parameters = run, dict(mission_state.state_parameters(folder))
        run.processes.start(SIMULATOR, [
            sys.executable, "-m", "rover_simulator.main", "--host", run.host, "--port",
            str(run.port), "--world", str(folder / "world"), "--seed", str(SEED), "--rate", "fast",
            "--fps", str(FPS), "--progress",
        ])  # fmt: skip

    def drive(self, seconds: float = DRIVEN) -> None:
        """Until so much mission time has passed since its newest report."""
        mission = self.run.watch.mission
        until = seconds + (0.0 if mission is None else mission.elapsed)
        wait(lambda: self.run.watch.mission and self.run.watch.mission.elapsed >= until)

    def kill(self, *names: str) -> None:
        """SIGKILL, and start them again."""
        children = {child.name: child for child in self.run.processes._children}
        for name in names:
            os.killpg(children[name].process.pid, signal.SIGKILL)
            children[name].process.wait()
            self.run.processes._children.remove(children[name])
        for name in names:
            values = {"use_sim_time": True, **OVERRIDES.get(name, {}), **self._parameters[name]}
            if name == "bridge_node":
                values |= {"host": HOST, "port": self.run.port}
            command = node_command(NODES[name], name, default_parameters(), values)
            self.run.processes.start(name, command)


def wait(condition) -> None:
    assert holds(condition, WAIT)


@pytest.fixture
def driven(tmp_path) -> Iterator[Driven]:
    generate_world(SEED, SIZE).save(tmp_path / "world")
    overrides = {
        node: {**OVERRIDES.get(node, {}), **values}
        for node, values in mission_state.state_parameters(tmp_path).items()
    }
    with running_graph(tmp_path, overrides) as run:
        yield Driven(run, tmp_path)


def test_mission_home_rocks_and_map_survive_the_kill_of_each_node_and_of_all(driven):
    start = generate_world(SEED, SIZE).start
    watch = driven.run.watch
    driven.drive()
    for names in [*((name,) for name in NODES), tuple(NODES)]:
        mission, rocks, grid = watch.mission, watch.rocks(), conversions.grid_of(watch.grid)
        driven.kill(*names)
        driven.drive()
        after, mapped = watch.mission, conversions.grid_of(watch.grid)
        assert after.run == mission.run == 1, names
        assert after.elapsed >= mission.elapsed + DRIVEN
        assert after.samples_total == mission.samples_total > 0
        assert after.samples_collected >= mission.samples_collected
        assert after.distance > 0.5 * mission.distance
        x, y = read_run(driven.run.folder / "log" / f"{SIMULATOR}.log").track[-1]
        moved = np.hypot(x - start.x, y - start.y)
        assert abs(after.home_distance - moved) < 5.0, names  # it stood there at another moment
        before = navigable_cells(grid.cells)
        assert navigable_cells(mapped.cells)[before].mean() > 0.9, names
        assert len(watch.rocks()) >= len(rocks)


def test_a_mission_goes_on_after_all_its_processes_were_killed(tmp_path):
    folder = tmp_path / "mission"
    command = [
        sys.executable, "-m", "rover_tools.cli.main", "mission", "--no-record", "--no-dashboard",
    ]  # fmt: skip
    limits = ["--seed", str(SEED), "--size", str(SIZE), "--fps", str(FPS), "--time-limit", "24"]
    with subprocess.Popen([*command, *limits, "--out", str(folder)]) as process:
        wait(lambda: last_line(folder) is not None and last_line(folder)[0] > 12.0)
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        for pid in [process.pid, *map(int, children)]:
            os.kill(pid, signal.SIGKILL)
    before = last_line(folder)
    resumed = subprocess.run(
        [*command, "--resume", str(folder)], timeout=5 * WAIT, check=True,
        capture_output=True, text=True,
    )  # fmt: skip
    log = (folder / "log" / "decision_node.log").read_text()
    assert "goes on with run 1" in log
    run = read_run(*mission_state.logs_of(folder, SIMULATOR))
    first = read_run(folder / "log" / f"{SIMULATOR}.log")
    assert np.hypot(*(first.track[0] - before[1:])) < 10.0
    assert len(run.track) > len(first.track)
    assert "home" in resumed.stdout or run.time >= 24.0 - START_TIME
    assert not (folder / mission_state.STATE).exists()


def last_line(folder: Path) -> tuple[float, float, float] | None:
    """Time [s] and position [m] that the simulator of the first part printed last."""
    logs = [path for path in folder.glob(f"log*/{SIMULATOR}.log") if path.read_text().strip()]
    if not logs:
        return None
    run = read_run(*sorted(logs, key=lambda path: len(path.parent.name))[-1:])
    return (run.time, *run.track[-1])
