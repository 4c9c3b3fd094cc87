"""A whole heat mission in the closed loop."""

from __future__ import annotations

from collections.abc import Callable

from burger_simulator.simulation import BurgerSimulation
from burger_simulator.world.maze import Maze
from rover_heat.mission.chart import State
from rover_tools.evaluation.heat_loop import HeatLoop, HeatStep
from rover_tools.evaluation.heat_mission_result import HeatRun
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.evaluation.heat_ticks import START_TIME, TickLog

SLACK = 30.0  # [s] after the time limit, for the mission to end by itself


def run_heat_mission(
    maze: Maze,
    seed: int,
    setup: HeatSetup,
    watch: Callable[[HeatLoop, HeatStep], object] = lambda loop, step: None,
) -> HeatRun:
    """Run one mission to its end; the same arguments give the same run.

    seed: of the sensors' noise. `watch` is called after every tick.
    """
    simulation = BurgerSimulation(maze, seed, setup.options)
    map_in_world = simulation.truth.pose
    log = TickLog(map_in_world)
    loop = HeatLoop(simulation, setup.config)

    def see(step: HeatStep) -> None:
        decision = step.decision
        log.add(step.truth, State(decision.state), step.frame.pose, decision.progress.explored)
        watch(loop, step)

    try:
        end = loop.run(START_TIME + setup.config.time_limit + SLACK, see)
    finally:
        loop.close()
    return HeatRun(
        State(end.decision.state),
        end.decision.reason,
        end.decision.progress.interrupts,
        end.overlay,
        end.grid,
        map_in_world,
        log.ticks(),
        end.truth,
    )
