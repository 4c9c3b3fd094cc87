"""The heat mission in one process and as a graph of nodes: the same, tick for tick."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from heat_lane import lane
from rclpy.node import Node
from rover_interfaces.msg import HeatState

from burger_simulator.node import BurgerNode
from burger_simulator.simulation import TICK, BurgerSimulation
from burger_simulator.truth import Truth
from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.conversions import stamp_of
from rover_common.ros.runner import EventsExecutor
from rover_heat import node_lockstep
from rover_heat.config import HeatConfig
from rover_heat.conversions import heat_state_of
from rover_heat.mission.chart import State
from rover_heat.node import HeatNode
from rover_navigation.navigator_config import NavigatorConfig
from rover_navigation.node import NavigatorNode
from rover_tools.evaluation.heat_loop import HeatLoop, HeatStep

EXECUTOR = EventsExecutor  # of the fixture `ros`
SEED, SAMPLES, NAVIGATOR_SEED = 3, 100, 5
TICKS = 780  # beyond the first launch, up to the ramp
MISSION = {"deliver": "at_once"}


def run_in_process() -> tuple[list[HeatStep], list[Truth]]:
    simulation = BurgerSimulation(lane(), SEED)
    settings = NavigatorConfig(samples=SAMPLES)
    loop = HeatLoop(simulation, HeatConfig(**MISSION), settings, NAVIGATOR_SEED)
    try:
        steps = [loop.step() for _ in range(TICKS)]
    finally:
        loop.close()
    return steps, [step.truth for step in steps]


class Graph:
    """Simulator, navigator and mission as nodes; what is true is taken from the simulator."""

    def __init__(self, ros: Any, world: Path) -> None:
        self.ros = ros
        self.reports: list[HeatState] = []
        self.truths: list[Truth] = []
        watcher = ros.add(lambda **kwargs: Node("watcher", **kwargs))
        watcher.create_subscription(HeatState, topics.HEAT_STATE, self.reports.append, qos.LATCHED)
        settings = {"samples": SAMPLES, "seed": NAVIGATOR_SEED}
        self.navigator = ros.add(NavigatorNode, lockstep=True, use_sim_time=True, **settings)
        self.mission = ros.add(HeatNode, lockstep=True, use_sim_time=True, **MISSION)
        lockstep = {"lockstep": True, "lockstep_with_mission": True, "answer_deadline": 60.0}
        self.robot = ros.add(BurgerNode, seed=SEED, world=str(world), rate=0.0, **lockstep)
        step = self.robot.simulation.step

        def recorded(*arguments: Any) -> Any:
            batch = step(*arguments)
            self.truths.append(self.robot.simulation.truth)
            return batch

        self.robot.simulation.step = recorded  # type: ignore[method-assign]

    def run(self) -> None:
        assert self.ros.spin_until(lambda: len(self.truths) >= TICKS, timeout=400.0)


@pytest.fixture
def graph(ros, tmp_path) -> Graph:
    lane().save(tmp_path / "lane.yaml")
    return Graph(ros, tmp_path / "lane.yaml")


def test_graph_and_loop_run_the_same_mission_bit_for_bit(graph):
    steps, truths = run_in_process()
    graph.run()
    pairs = enumerate(zip(truths, graph.truths, strict=False))
    assert [tick for tick, (loop, nodes) in pairs if loop != nodes][:3] == []
    assert graph.mission._lockstep.missing == 0
    said = {
        step.frame.stamp: heat_state_of(step.frame.stamp, step.frame.run, step.decision)
        for step in steps
    }
    known = [report for report in graph.reports if stamp_of(report.header.stamp) in said]
    assert [said[stamp_of(report.header.stamp)] for report in known] == known
    assert len(known) > TICKS * TICK
    states = {report.state_name for report in known}
    assert states >= {"INITIALIZING", "EXPLORING", "TILT_INTERRUPT", "LAUNCHING"}
    assert len(truths[-1].launches) == 1


def test_the_graph_goes_on_standing_without_its_navigator(graph, monkeypatch):
    """Nothing hangs, and the mission says what is missing."""
    monkeypatch.setattr(node_lockstep, "PATIENCE", 2.0)  # [s] less than the simulator's
    monkeypatch.setattr(node_lockstep, "PATIENCE_ABSENT", 0.1)
    graph.robot._lockstep._deadline = 5.0
    assert graph.ros.spin_until(lambda: len(graph.truths) >= 100, timeout=100.0)
    graph.navigator._step_when_complete = lambda: None  # it lives, and says nothing
    count = len(graph.truths)
    assert graph.ros.spin_until(lambda: len(graph.truths) >= count + 30, timeout=100.0)
    assert graph.mission._core.state is State.HOLD
    assert graph.truths[-1].speed == pytest.approx(0.0, abs=0.01)
    assert graph.mission._lockstep.missing >= 30
