"""The closed loop in one process and the graph of nodes: the same mission, frame for frame."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

import pytest

from rover_bridge.codec import encode_drive
from rover_bridge.node import BridgeNode
from rover_common.geometry import Pose
from rover_common.types import Command
from rover_decision.node import DecisionNode
from rover_perception.node import PerceptionNode
from rover_simulator.simulation import Simulation
from rover_simulator.wire.unity_client import OPEN, UnityClient
from rover_simulator.world.generator import generate_world
from rover_simulator.world.world import World
from rover_tools.evaluation.closed_loop import Loop

FRAME_STEPS = 4  # 12.5 frames a second
FRAMES = 330  # up to a pickup
Answer = tuple[str, Mapping[str, Any]]


@pytest.fixture(scope="module")
def world() -> World:
    """A canyon, with a sample in sight of the start."""
    world = generate_world(23)
    start = Pose(world.samples[0][0] + 3.0, world.samples[0][1], 3.0)
    near = world.navigable[int(start.y), int(start.x)]
    return World(world.name, world.navigable, world.samples, start if near else world.start)


def answer_of(command: Command) -> Answer:
    return ("pickup", {}) if command.pickup else ("data", encode_drive(command))


def without_pictures(answer: Answer) -> Answer:
    """The bridge may send inset pictures with a command."""
    name, data = answer
    return name, {key: value for key, value in data.items() if not key.startswith("inset")}


def fly_in_process(world: World) -> tuple[list[Answer], list[Pose]]:
    simulation = Simulation(world, 0, FRAME_STEPS)
    loop = Loop(simulation)
    answers: list[Answer] = []
    poses: list[Pose] = []
    first = [loop.decide(), loop.decide()]  # as the simulator sends them when it connects
    try:
        for frame in range(FRAMES):
            decisions = first if frame == 0 else [loop.decide()]
            for decision in decisions:
                answers.append(answer_of(decision.command))
                simulation.handle(*answers[-1])
            simulation.advance()
            poses.append(simulation.pose)
    finally:
        loop.close()
    return answers, poses


def fly_in_graph(ros, world: World) -> tuple[list[Answer], list[Pose]]:
    bridge = ros.add(BridgeNode, port=0, answer_deadline=10.0)
    nodes = (bridge, ros.add(PerceptionNode), ros.add(DecisionNode, use_sim_time=True))
    assert ros.spin_until(
        lambda: all(peer() for node in nodes for peer in node._diagnostics._peers.values())
    )
    simulation = Simulation(world, 0, FRAME_STEPS)
    answers: list[Answer] = []
    poses: list[Pose] = []

    def drive() -> None:
        client = UnityClient("127.0.0.1", bridge.port)
        client.connect(timeout=5)
        client.send_telemetry(simulation.telemetry())
        waiting = 1
        while len(poses) < FRAMES:
            event = client.receive(10.0)
            if event is None:
                break
            if event.name == OPEN:
                client.send_telemetry(simulation.telemetry())
                waiting += 1
                continue
            answers.append((event.name, event.data))
            simulation.handle(event.name, event.data)
            waiting -= 1
            if waiting == 0:
                simulation.advance()
                poses.append(simulation.pose)
                client.send_telemetry(simulation.telemetry())
                waiting = 1
        client.close()

    thread = threading.Thread(target=drive)
    thread.start()
    assert ros.spin_until(lambda: not thread.is_alive(), timeout=120)
    thread.join()
    return answers, poses


def test_graph_and_loop_fly_the_same_mission(ros, world):
    answers, poses = fly_in_process(world)
    graph_answers, graph_poses = fly_in_graph(ros, world)
    assert len(graph_poses) == FRAMES
    pairs = zip(map(without_pictures, answers), map(without_pictures, graph_answers), strict=True)
    differing = [(index, *pair) for index, pair in enumerate(pairs) if pair[0] != pair[1]]
    assert differing[:3] == []
    assert graph_poses == poses
    assert ("pickup", {}) in answers
