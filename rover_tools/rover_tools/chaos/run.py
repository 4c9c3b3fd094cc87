"""A mission in the graph in real time, with faults, and what became of both."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from rover_simulator.world.world import World
from rover_tools.chaos.executor import Executor
from rover_tools.chaos.faults import Faults
from rover_tools.chaos.node_graph_faults import GraphFaults
from rover_tools.chaos.node_mission_watch import MissionWatch
from rover_tools.chaos.outcome import chaos_result, fault_line, write_faults
from rover_tools.chaos.plan import plan_faults
from rover_tools.evaluation.mission_result import mission_result, truth_of
from rover_tools.evaluation.results import Result, write_results
from rover_tools.evaluation.strategy import Strategy
from rover_tools.output import note
from rover_tools.runner import mission_state
from rover_tools.runner.graph import NODES, default_parameters
from rover_tools.runner.mission import (
    SIMULATOR,
    end_and_measure,
    simulator_command,
    watch_mission,
)
from rover_tools.runner.run import Run, running_graph

RESPAWNS = 1_000  # more than kills: a node that is killed is no node that is broken
LIMIT = 300.0  # [s] of simulated time for a mission, beside twice that of its faults


@dataclass(frozen=True)
class Chaos:
    """What is to come."""

    seed: int  # of the faults, and of what is random in the world
    minutes: float  # [min] of wall time in which faults begin
    rate: float  # times real time
    fps: float  # frames per simulated second
    parameters: Path | None = None  # those that ship

    @property
    def time_limit(self) -> float:
        """[s] of simulated time for the mission."""
        return LIMIT + 2.0 * 60.0 * self.minutes * self.rate


def run_chaos(world: World, chaos: Chaos, folder: Path) -> Result:
    """Run one mission with faults to its end, score it, and write the result folder.

    Raises ParametersError, GraphNotReadyError or ProcessDiedError.
    """
    world.save(folder / "world")
    strategy = Strategy.of_parameters(chaos.parameters or default_parameters())
    watch, start = partial(MissionWatch, home=(world.start.x, world.start.y)), time.monotonic()
    mission_state.end(folder)  # what another mission has left there
    states = mission_state.state_parameters(folder)
    with running_graph(folder, states, chaos.parameters, watch) as run:
        assert isinstance(run.watch, MissionWatch)
        run.processes.respawn(NODES, RESPAWNS)
        run.processes.start(SIMULATOR, _simulator_command(run, chaos))
        with _faults(run, run.watch, chaos) as executor:
            done = watch_mission(run, chaos.time_limit, partial(_tick, executor, run))
        at_end = run.watch.losses()
        measured, grid = end_and_measure(run)
        mission, rocks = run.watch.mission, run.watch.rocks()
        respawns = run.processes.respawns()
    mission_state.end(folder)
    scored = mission_result(
        world, str(strategy), chaos.seed, done=done, run=measured, grid=grid, rocks=rocks,
        recoveries=None if mission is None else mission.recoveries,
        wall_seconds=time.monotonic() - start,
    )  # fmt: skip
    scored |= {"minutes": chaos.minutes, "rate": chaos.rate}
    result = chaos_result(scored, executor.outcomes, at_end, respawns, _last_line(folder))
    write_results(folder, result, grid, measured.track, rocks, truth_of(world), world.name)
    write_faults(folder, executor.outcomes)
    return result


def _simulator_command(run: Run, chaos: Chaos) -> list[str]:
    rate = str(chaos.rate)
    return simulator_command(run, chaos.seed, chaos.fps, chaos.time_limit, rate)


@contextmanager
def _faults(run: Run, watch: MissionWatch, chaos: Chaos) -> Iterator[Executor]:
    """Lets the faults of the plan come; none is in force after the block."""
    with GraphFaults(run.domain_id) as graph:
        publish = partial(graph.publish, watch.newest)
        faults = Faults(run.processes, run.port, publish, chaos.seed)
        plan = plan_faults(chaos.seed, 60.0 * chaos.minutes)
        executor = Executor(plan, faults.begin, watch, lambda outcome: note(fault_line(outcome)))
        try:
            yield executor
        finally:  # a node that is stopped does not hear that it is to end
            executor.close(time.monotonic())


def _tick(executor: Executor, run: Run) -> None:
    """Faults are for a mission that has begun."""
    if run.watch.mission is not None:
        executor.tick(time.monotonic())


def _last_line(folder: Path) -> dict[str, Any]:
    """Of the progress that the simulator printed."""
    log = (folder / "log" / f"{SIMULATOR}.log").read_text()
    lines = [line for line in log.splitlines() if line.startswith("{")]
    return dict(json.loads(lines[-1])) if lines else {}
