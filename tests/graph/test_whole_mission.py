"""A whole mission with the rendered camera, to home, in a small canyon."""

from __future__ import annotations

import math

from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_simulator.simulation import START_TIME, Simulation
from rover_simulator.world.generator import generate_world
from rover_tools.evaluation.closed_loop import Loop

SEED, SIZE = 11, 0.1  # a canyon whose mission ends soon
TIME_LIMIT = 300.0  # [s]
FRAME_STEPS = 5  # 10 frames a second


def test_a_mission_collects_all_samples_and_comes_home():
    world = generate_world(SEED, SIZE)
    simulation = Simulation(world, SEED, FRAME_STEPS)
    loop = Loop(simulation)
    states: set[State] = set()
    try:
        end = loop.run(START_TIME + TIME_LIMIT, lambda decision: states.add(decision.state))
    finally:
        loop.close()
    assert end.done
    assert {State.FORWARD, State.ROCK_APPROACH, State.PICKUP, State.RETURN_HOME} <= states
    home = math.dist((simulation.pose.x, simulation.pose.y), (world.start.x, world.start.y))
    assert home < DecisionConfig().home_radius + ROVER.body_front
    assert simulation.samples_left == 0
    assert end.decision.progress.samples_collected == len(world.samples) > 3
    assert simulation.contacts <= 1
    assert loop.core.plan_failures == 0
