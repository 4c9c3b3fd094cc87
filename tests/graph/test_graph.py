"""The three nodes together: telemetry in at the socket, decisions out of it."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rover_interfaces.msg import DriveCommand, MissionState
from std_srvs.srv import Trigger

from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.geometry import Pose
from rover_common.map_encoding import navigable_cells
from rover_common.ros import conversions, qos
from rover_decision.node import DecisionNode
from rover_perception.node import PerceptionNode
from rover_simulator.recordings.recording import RecordedFrame, read_recording
from rover_simulator.recordings.replay import play
from rover_simulator.wire.unity_client import UnityClient

FRAMES = 40


@pytest.fixture
def drive(tmp_path):
    """A short drive along a corridor, as a recorded run."""
    import cv2
    from scene import draw

    (tmp_path / "IMG").mkdir()
    lines = ["Path;SteerAngle;Throttle;Brake;Speed;X_Position;Y_Position;Pitch;Yaw;Roll"]
    for index in range(FRAMES):
        pose = Pose(90.0 + 0.2 * index, 100.0, 0.0)
        image = draw(pose, lambda x, y: (y > 95) & (y < 105))
        name = f"IMG/{index:03d}.jpg"
        cv2.imwrite(str(tmp_path / name), cv2.cvtColor(image, cv2.COLOR_RGB2BGR))
        lines.append(f"{name};0;0;0;1;{pose.x};{pose.y};0;0;0")
    (tmp_path / "robot_log.csv").write_text("\n".join(lines))
    return read_recording(tmp_path)


@pytest.fixture
def graph(ros):
    bridge = ros.add(BridgeNode, port=0, answer_deadline=5.0)
    perception = ros.add(PerceptionNode, image_lag=0)
    decision = ros.add(DecisionNode)
    nodes = (bridge, perception, decision)

    def connected() -> bool:
        return all(peer() for node in nodes for peer in node._diagnostics._peers.values())

    assert ros.spin_until(connected)
    return bridge


def replay(ros, port: int, recording):
    """Play the recording in a thread while the nodes are spun here."""
    results = []

    def run() -> None:
        client = UnityClient("127.0.0.1", port)
        client.connect(timeout=5)
        results.append(play(recording, client, in_flight=2))
        client.close()

    thread = threading.Thread(target=run)
    thread.start()
    assert ros.spin_until(lambda: not thread.is_alive(), timeout=60)
    thread.join()
    return results[0]


def test_every_frame_is_decided_on_and_mapped(ros, graph, drive):
    commands: list[DriveCommand] = []
    grids: list[OccupancyGrid] = []
    states: list[MissionState] = []
    watcher = ros.add(lambda **kwargs: Node("watcher", **kwargs))
    watcher.create_subscription(DriveCommand, topics.COMMAND, commands.append, qos.FRAME)
    watcher.create_subscription(OccupancyGrid, topics.WORLDMAP, grids.append, qos.LATCHED)
    watcher.create_subscription(MissionState, topics.MISSION_STATE, states.append, qos.LATCHED)
    assert ros.spin_until(lambda: watcher.count_publishers(topics.COMMAND) > 0)

    playback = replay(ros, graph.port, drive)

    assert playback.frames == FRAMES
    assert ros.spin_until(lambda: len(commands) == FRAMES)
    stamps = [conversions.command_of(command)[0] for command in commands]
    assert len(set(stamps)) == FRAMES
    assert graph._diagnostics.counts["answered"] == FRAMES
    last = stamps[-1]
    assert ros.spin_until(lambda: grids and conversions.stamp_of(grids[-1].header.stamp) >= last)
    free = navigable_cells(np.array(grids[-1].data, np.int8).reshape(200, 200))
    assert free[97:103, 93:101].all()
    assert not free[:94].any()
    assert not free[106:].any()
    assert states[-1].state_name == "FORWARD"
    assert any(command.throttle > 0 for command in commands)


def test_services(ros, graph):
    caller = ros.add(lambda **kwargs: Node("caller", **kwargs))

    def call(name: str) -> Trigger.Response:
        client = caller.create_client(Trigger, f"/decision_node/{name}")
        assert ros.spin_until(client.service_is_ready)
        future = client.call_async(Trigger.Request())
        assert ros.spin_until(future.done)
        return future.result()

    assert call("pause").success
    assert not call("pause").success
    assert call("resume").success
    assert call("return_home").message.endswith("RETURN_HOME")
    assert call("reset").success


def moved(frame: RecordedFrame, x: float = 50.0) -> RecordedFrame:
    """The same frame somewhere else."""
    return replace(frame, pose=replace(frame.pose, x=frame.pose.x + x))


def test_a_stray_pose_and_the_way_back_leave_map_and_mission_as_they_were(ros, graph, drive):
    """The bridge leaves the frame out; no node forgets anything."""
    perception, decision = ros.nodes[1:3]
    frames = list(drive.frames)
    for index in (FRAMES // 2, FRAMES - 2):
        frames[index] = moved(frames[index])
    assert replay(ros, graph.port, replace(drive, frames=tuple(frames))).frames == FRAMES
    assert ros.spin_until(lambda: perception._diagnostics.counts["frames"] == FRAMES - 2)
    cells = perception._core.world_map().cells
    assert navigable_cells(cells)[96:104, 92:100].mean() > 0.9  # also from before the first one
    assert (cells[:, 120:] < 0).all()
    assert graph._diagnostics.counts["runs"] == 1
    assert decision._core.mission._parts.home == pytest.approx((90.0, 100.0))
    assert decision._core.mission_number == 1


def test_a_lasting_jump_is_a_new_run(ros, graph, drive):
    perception, decision = ros.nodes[1:3]
    frames = [moved(f) if i >= FRAMES // 2 else f for i, f in enumerate(drive.frames)]
    replay(ros, graph.port, replace(drive, frames=tuple(frames)))
    assert ros.spin_until(lambda: perception._diagnostics.counts["frames"] == FRAMES - 2)
    cells = perception._core.world_map().cells
    assert (cells[:, :130] < 0).all()
    assert navigable_cells(cells)[98:102, 148:151].mean() > 0.9
    assert graph._diagnostics.counts["runs"] == 2
    assert ros.spin_until(lambda: decision._core.mission_number == 2)
