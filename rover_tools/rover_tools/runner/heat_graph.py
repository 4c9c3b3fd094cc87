"""The heat mission's nodes as processes, with the simulator in lockstep."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import yaml

from rover_common.whole_file import write_whole
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.output import note
from rover_tools.report.heat_truth import MAZE, TRUTH
from rover_tools.runner import mission_state
from rover_tools.runner.graph import node_command
from rover_tools.runner.node_heat_watch import SIMULATOR, HeatWatch
from rover_tools.runner.run import ProcessRun, reserved_run

NODES = {
    SIMULATOR: "burger_simulator",
    "navigator_node": "rover_navigation",
    "heat_node": "rover_heat",
}
KEPT = ("navigator_node", "heat_node")  # those that go on when they are started again
PARAMETERS = "parameters.yaml"
ANSWER_DEADLINE = 60.0  # [s] of wall time: a slow machine changes nothing

HeatProcesses = ProcessRun[HeatWatch]


@contextmanager
def heat_graph(folder: Path, seed: int, setup: HeatSetup) -> Iterator[HeatProcesses]:
    """Start the nodes in the folder's maze and wait until they are connected.

    The simulator stands still until it is resumed; everything ends with the block, and what the
    nodes have saved goes with it. Raises DomainError, GraphNotReadyError or ProcessDiedError.
    """
    mission_state.end(folder)  # of a mission that was killed there
    parameters = folder.absolute() / PARAMETERS
    write_whole(parameters, yaml.safe_dump(_parameters(folder.absolute(), seed, setup)))
    with reserved_run(folder, HeatWatch) as run:
        for node, package in NODES.items():
            command = node_command(package, node, parameters, {"use_sim_time": node != SIMULATOR})
            run.processes.start(node, command)
        note(f"starting the graph; watch it with ROS_DOMAIN_ID={run.domain_id}")
        run.wait_ready(NODES)
        yield run
    mission_state.end(folder)


def _parameters(folder: Path, seed: int, setup: HeatSetup) -> dict[str, Any]:
    """A file of parameters of all nodes."""
    simulator = asdict(setup.options) | {
        "world": str(folder / MAZE),
        "seed": seed,
        "rate": 0.0,
        "start_paused": True,
        "lockstep": True,
        "lockstep_with_mission": True,
        "answer_deadline": ANSWER_DEADLINE,
        "truth_file": str(folder / TRUTH),
    }
    kept = {"lockstep": True, "state_dir": str(folder / mission_state.STATE)}
    values = {
        SIMULATOR: simulator,
        "navigator_node": kept,
        "heat_node": asdict(setup.config) | kept,
    }
    return {f"/**/{node}": {"ros__parameters": each} for node, each in values.items()}
