"""The closed loop in one process and the graph of nodes: the same mission, frame for frame."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

import pytest
from rclpy.node import Node
from rover_interfaces.msg import (
    DriveCommand,
    MissionState,
    PolarArray,
    RockTrackArray,
    RoverStatus,
)

from rover_bridge.codec import encode_drive
from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_common.types import Command
from rover_decision.node import DecisionNode
from rover_perception.node import PerceptionNode
from rover_simulator.simulation import Simulation
from rover_simulator.wire.unity_client import OPEN, UnityClient
from rover_simulator.world.generator import generate_world
from rover_simulator.world.world import World
from rover_tools.evaluation.closed_loop import Loop
from rover_tools.evaluation.strategy import Strategy

FRAME_STEPS = 5  # 10 frames a second
FRAMES = 265  # up to a pickup
CLASSIC_FRAMES = 120  # up to a pickup
TOUR = Strategy()
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


def run_in_process(
    world: World, strategy: Strategy, frames: int
) -> tuple[list[Answer], list[Pose]]:
    simulation = Simulation(world, 0, FRAME_STEPS)
    loop = Loop(simulation, strategy.config(), strategy.perception())
    answers: list[Answer] = []
    poses: list[Pose] = []
    first = [loop.decide(), loop.decide()]  # as the simulator sends them when it connects
    try:
        for frame in range(frames):
            decisions = first if frame == 0 else [loop.decide()]
            for decision in decisions:
                answers.append(answer_of(decision.command))
                simulation.handle(*answers[-1])
            simulation.advance()
            poses.append(simulation.pose)
    finally:
        loop.close()
    return answers, poses


class Graph:
    """The three nodes in lockstep, and a simulator at their socket."""

    def __init__(self, ros: Any, strategy: Strategy = TOUR) -> None:
        self._ros = ros
        self._bridge = ros.add(BridgeNode, port=0, answer_deadline=10.0)
        parameters = strategy.parameters()
        perception = ros.add(PerceptionNode, **parameters["perception_node"])
        decision = ros.add(DecisionNode, use_sim_time=True, **parameters["decision_node"])
        nodes = (self._bridge, perception, decision)
        assert ros.spin_until(
            lambda: all(peer() for node in nodes for peer in node._diagnostics._peers.values())
        )

    def run(self, *lengths: int, world: World) -> list[tuple[list[Answer], list[Pose]]]:
        """Answers and poses of scenes of so many frames; the simulator resets between them."""
        scenes: list[tuple[list[Answer], list[Pose]]] = []

        def drive() -> None:
            client = UnityClient("127.0.0.1", self._bridge.port)
            client.connect(timeout=5)
            for frames in lengths:
                simulation = Simulation(world, 0, FRAME_STEPS)
                if scenes:  # as the simulator sends them when it connects, to compare the scenes
                    client.send_telemetry(simulation.telemetry())
                scenes.append(([], []))
                drive_scene(client, simulation, frames, 2 if scenes[1:] else 1, *scenes[-1])
            client.close()

        thread = threading.Thread(target=drive)
        thread.start()
        assert self._ros.spin_until(lambda: not thread.is_alive(), timeout=120)
        thread.join()
        return scenes


def drive_scene(
    client: UnityClient,
    simulation: Simulation,
    frames: int,
    waiting: int,
    answers: list[Answer],
    poses: list[Pose],
) -> None:
    """From the scene's first telemetry on, each frame when all before are answered.

    waiting: for so many answers, the first telemetry's included.
    """
    client.send_telemetry(simulation.telemetry())
    while len(poses) < frames:
        event = client.receive(10.0)
        if event is None:
            return
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
            if len(poses) < frames:
                client.send_telemetry(simulation.telemetry())
                waiting = 1


@pytest.mark.parametrize(
    ("strategy", "frames", "last"),
    [
        (TOUR, FRAMES, Command(pickup=True)),
        (Strategy.parse("classic_b"), CLASSIC_FRAMES, Command(pickup=True)),
    ],
    ids=["tour", "classic_b"],
)
def test_graph_and_loop_run_the_same_mission(ros, world, strategy, frames, last):
    answers, poses = run_in_process(world, strategy, frames)
    ((graph_answers, graph_poses),) = Graph(ros, strategy).run(frames, world=world)
    assert len(graph_poses) == frames
    pairs = zip(map(without_pictures, answers), map(without_pictures, graph_answers), strict=True)
    differing = [(index, *pair) for index, pair in enumerate(pairs) if pair[0] != pair[1]]
    assert differing[:3] == []
    assert graph_poses == poses
    assert without_pictures(answer_of(last)) in map(without_pictures, answers)


RUN_OF = {  # topics that tell the run, and where
    topics.STATUS: (RoverStatus, qos.FRAME),
    topics.NAV_POLAR: (PolarArray, qos.FRAME),
    topics.ROCK_POLAR: (PolarArray, qos.FRAME),
    topics.ROCKS: (RockTrackArray, qos.FRAME),
    topics.COMMAND: (DriveCommand, qos.FRAME),
    topics.MISSION_STATE: (MissionState, qos.LATCHED),
}


def test_a_reset_of_the_scene_begins_run_2_in_every_node(ros, world):
    graph = Graph(ros)
    watcher = ros.add(lambda **kwargs: Node("watcher", **kwargs))
    messages: dict[str, list[Any]] = {topic: [] for topic in RUN_OF}
    for topic, (kind, profile) in RUN_OF.items():
        watcher.create_subscription(kind, topic, messages[topic].append, profile)
        assert ros.spin_until(lambda topic=topic: watcher.count_publishers(topic) > 0)
    (_, first), (answers, second) = graph.run(40, 25, world=world)
    assert ros.spin_until(lambda: messages[topics.COMMAND][-1].run == 2)
    for topic, received in messages.items():
        assert ros.spin_until(lambda received=received: received[-1].run == 2), topic
        runs = [message.run for message in received]
        assert runs == sorted(runs), topic
        assert set(runs) == {1, 2}
        stamps = [conversions.stamp_of(message.header.stamp) for message in received]
        assert stamps == sorted(stamps), topic
    reports = [report for report in messages[topics.MISSION_STATE] if report.run == 2]
    assert (reports[0].elapsed, reports[0].distance) == (pytest.approx(0.0, abs=0.1), 0.0)
    assert (len(first), len(answers)) == (40, 26)
    refused = sum("refused" in data for _, data in answers)  # until the clock is confirmed
    assert second[refused:] == first[: 25 - refused]  # it drives as it did
    assert second[-1] != second[0]
