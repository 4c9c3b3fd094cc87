"""Nodes that are stopped or killed while the rover drives: it brakes, says why, and goes on."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator

import pytest
from brake_times import DEAD_MAN, WAIT, WatchedSimulation, simulating
from diagnostic_msgs.msg import DiagnosticStatus
from waiting import holds

from rover_common import nodes
from rover_simulator.world.generator import generate_world
from rover_tools.runner.graph import NODES
from rover_tools.runner.run import Run, running_graph

SEED = 5
FRAME_STEPS = 5  # ten frames a second, which most machines can make
Driving = tuple[WatchedSimulation, Run]


@pytest.fixture(scope="module")
def driving(tmp_path_factory) -> Iterator[Driving]:
    """A graph and the simulator in real time."""
    simulation = WatchedSimulation(generate_world(SEED, 0.6), SEED, FRAME_STEPS, DEAD_MAN)
    with running_graph(tmp_path_factory.mktemp("run")) as run:
        run.processes.respawn(NODES)
        with simulating(simulation, run, FRAME_STEPS):
            yield simulation, run


def health(run: Run) -> DiagnosticStatus:
    return run.watch.diagnostics.get("/rover", DiagnosticStatus())


def wait_until_it_drives(driving: Driving) -> None:
    simulation, run = driving

    def drives() -> bool:
        run.processes.check()
        return simulation.driving and simulation.speed > 0.3

    assert holds(drives, WAIT), health(run).message


def is_silent(run: Run, node: str) -> bool:
    """Whether this node's silence is the cause of all trouble."""
    told = health(run)
    return told.level == DiagnosticStatus.ERROR and f"{node}: silent for " in told.message


def wait_until_silence_is_told(run: Run, node: str) -> None:
    assert holds(lambda: is_silent(run, node), WAIT), health(run).message


def wait_until_it_is_heard(run: Run, node: str) -> None:
    assert holds(lambda: not is_silent(run, node), WAIT), health(run).message


@pytest.mark.parametrize("node", NODES)
def test_the_rover_brakes_while_a_node_is_stopped_and_goes_on_afterwards(driving, node):
    simulation, run = driving
    wait_until_it_drives(driving)
    pid = run.processes.pid(node)
    os.kill(pid, signal.SIGSTOP)
    try:
        assert holds(lambda: not simulation.driving and simulation.speed == 0.0, WAIT)
        wait_until_silence_is_told(run, node)
    finally:
        os.kill(pid, signal.SIGCONT)
    wait_until_it_is_heard(run, node)
    wait_until_it_drives(driving)


@pytest.mark.parametrize("node", NODES)
def test_the_rover_brakes_when_a_node_is_killed_and_goes_on_with_another_one(driving, node):
    simulation, run = driving
    wait_until_it_drives(driving)
    stops, pid = simulation.dead_man_stops, run.processes.pid(node)
    os.kill(pid, signal.SIGKILL)
    assert holds(lambda: not simulation.driving and simulation.speed == 0.0, WAIT)
    wait_until_silence_is_told(run, node)
    if node == nodes.BRIDGE:
        assert simulation.dead_man_stops == stops + 1
    run.processes.check()
    assert run.processes.pid(node) != pid
    wait_until_it_is_heard(run, node)
    wait_until_it_drives(driving)
