"""burger_node: its topics, frames, velocities, launches, services and parameters."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import pytest
from geometry_msgs.msg import Twist as TwistMsg
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from node_endpoints import endpoints, listed
from rclpy.node import Node
from rclpy.qos import QoSProfile
from readme_tables import ROOT, table
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Float32MultiArray, Int32, String
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from burger_simulator.config import BurgerConfig
from burger_simulator.node import BurgerNode
from burger_simulator.options import BurgerOptions
from burger_simulator.simulation import BurgerSimulation
from burger_simulator.truth_file import TruthFile
from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import MazeError
from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.conversions import stamp_of
from rover_common.ros.parameters import ParameterError
from rover_common.ros.sensor_conversions import stamped_twist_message_of, twist_message_of
from rover_common.sensor_types import Twist

README = ROOT / "burger_simulator" / "README.md"
FAST = {"rate": 0.0, "family": "demo"}


class Watcher(Node):
    """Keeps what it hears, and drives."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("watcher", **kwargs)

    def watch(self, kind: type, topic: str, profile: QoSProfile) -> list[Any]:
        heard: list[Any] = []
        self.create_subscription(kind, topic, heard.append, profile)
        return heard


@pytest.fixture
def watcher(ros) -> Watcher:
    return ros.add(Watcher)


def test_every_sensor_speaks_in_its_frame(ros, watcher):
    scans = watcher.watch(LaserScan, topics.SCAN, qos.SCAN)
    imus = watcher.watch(Imu, topics.IMU, qos.IMU)
    odometry = watcher.watch(Odometry, topics.ODOMETRY, qos.SENSOR)
    left = watcher.watch(Float32MultiArray, topics.TEMPERATURE_1, qos.SENSOR)
    ahead = watcher.watch(Float32MultiArray, topics.TEMPERATURE_2, qos.SENSOR)
    clocks = watcher.watch(Clock, "/clock", qos.CLOCK)
    node = ros.add(BurgerNode, **FAST)
    heard = (scans, imus, odometry, left, ahead, clocks)
    assert ros.spin_until(lambda: all(len(messages) > 2 for messages in heard))
    assert (scans[0].header.frame_id, len(scans[0].ranges)) == ("base_scan", 230)
    assert imus[0].header.frame_id == "imu_link"
    assert imus[0].linear_acceleration.z == pytest.approx(9.8, abs=0.2)
    assert (odometry[0].header.frame_id, odometry[0].child_frame_id) == ("odom", "base_footprint")
    assert len(left[0].data) == len(ahead[0].data) == 64
    assert stamp_of(clocks[-1].clock) <= node.simulation.stamp
    steps = {stamp_of(b.header.stamp) - stamp_of(a.header.stamp) for a, b in pairwise(imus)}
    assert 10_000_000 in steps


def test_the_frames_are_a_chain_from_odom_to_each_sensor(ros, watcher):
    moving = watcher.watch(TFMessage, "/tf", qos.TF)
    static = watcher.watch(TFMessage, "/tf_static", qos.TF_STATIC)
    ros.add(BurgerNode, thermal_yaw_1=0.5, **FAST)
    assert ros.spin_until(lambda: moving and static)
    (link,) = moving[0].transforms
    assert (link.header.frame_id, link.child_frame_id) == ("odom", "base_footprint")
    links = {link.child_frame_id: link for link in static[0].transforms}
    parents = {child: link.header.frame_id for child, link in links.items()}
    assert parents == {
        "base_link": "base_footprint",
        "base_scan": "base_link",
        "imu_link": "base_link",
        "thermal_1_link": "base_link",
        "thermal_2_link": "base_link",
    }
    up = {child: link.transform.translation.z for child, link in links.items()}
    assert up["base_link"] + up["base_scan"] == pytest.approx(0.18)
    assert up["base_link"] + up["thermal_1_link"] == pytest.approx(0.12)
    assert links["thermal_1_link"].transform.rotation.z == pytest.approx(math.sin(0.25))
    assert links["thermal_2_link"].transform.rotation.z == 0.0


@pytest.mark.parametrize("stamped", [True, False])
def test_it_drives_as_cmd_vel_says_and_stops_when_that_is_silent(ros, watcher, stamped):
    kind = TwistStamped if stamped else TwistMsg
    driver = watcher.create_publisher(kind, topics.CMD_VEL, qos.CONTROL)
    node = ros.add(BurgerNode, family="large", rate=10.0, stamped_cmd_vel=stamped)
    assert ros.spin_until(lambda: driver.get_subscription_count() > 0)

    def drive() -> bool:
        twist = Twist(0.1, 0.0)
        message = stamped_twist_message_of(0, twist) if stamped else twist_message_of(twist)
        driver.publish(message)
        return node.simulation.truth.speed > 0.09

    assert ros.spin_until(drive)
    assert ros.spin_until(lambda: abs(node.simulation.truth.speed) < 0.01)
    assert node.simulation.truth.distance > 0.01
    assert node.simulation.truth.contacts == 0


def test_a_velocity_that_is_no_number_stands(ros, watcher):
    driver = watcher.create_publisher(TwistStamped, topics.CMD_VEL, qos.CONTROL)
    node = ros.add(BurgerNode, **FAST)
    assert ros.spin_until(lambda: driver.get_subscription_count() > 0)
    driver.publish(stamped_twist_message_of(0, Twist(math.nan, 0.0)))
    assert ros.spin_until(lambda: node.counts["refused_cmd_vel_not_finite"] == 1)
    assert ros.spin_until(lambda: node.simulation.time > 2.0)
    assert node.simulation.truth.distance < 0.01


def test_a_signal_begins_a_sequence_and_its_end_is_reported(ros, watcher):
    reports = watcher.watch(String, topics.FLYWHEEL_STATUS, qos.CONTROL)
    flywheel = watcher.create_publisher(Int32, topics.FLYWHEEL, qos.CONTROL)
    node = ros.add(BurgerNode, start_paused=True, **FAST)
    assert ros.spin_until(
        lambda: flywheel.get_subscription_count() and node._topics.launched.get_subscription_count()
    )
    flywheel.publish(Int32(data=0))
    assert not ros.spin_until(lambda: node._launch, timeout=0.3)
    flywheel.publish(Int32(data=50))
    assert ros.spin_until(lambda: node._launch)
    node.pause(False)
    assert ros.spin_until(lambda: reports)
    assert [report.data for report in reports] == ["done"]
    (launch,) = node.simulation.truth.launches
    assert launch.time == 1.0


def call(ros: Any, node: Node, name: str) -> str:
    client = node.create_client(Trigger, f"burger_node/{name}")
    assert ros.spin_until(client.service_is_ready)
    future = client.call_async(Trigger.Request())
    assert ros.spin_until(future.done)
    return future.result().message


def test_time_stands_still_while_it_is_paused(ros, watcher):
    node = ros.add(BurgerNode, start_paused=True, **FAST)
    assert not ros.spin_until(lambda: node.simulation.time > 1.0, timeout=0.3)
    assert call(ros, watcher, "resume") == "running"
    assert ros.spin_until(lambda: node.simulation.time > 1.5)
    assert call(ros, watcher, "pause") == "paused"
    stopped = node.simulation.time
    assert not ros.spin_until(lambda: node.simulation.time > stopped, timeout=0.3)


def test_the_world_is_that_of_the_seed_or_of_a_file(ros, tmp_path):
    maze = generate_maze(9, "flat")
    maze.save(tmp_path / "maze.yaml")
    of_file = ros.add(BurgerNode, world=str(tmp_path / "maze.yaml"), start_paused=True)
    assert of_file.simulation.maze == maze
    of_seed = ros.add(BurgerNode, seed=9, family="flat", start_paused=True)
    assert of_seed.simulation.maze == maze


@pytest.mark.parametrize(
    ("parameters", "error"),
    [
        ({"family": "canyon"}, ParameterError),
        ({"world": "missing.yaml"}, MazeError),
        ({"thermal_flip_1": "upside down"}, ParameterError),
    ],
)
def test_what_cannot_be_simulated_is_an_error(ros, parameters, error):
    with pytest.raises(error):
        ros.add(BurgerNode, **parameters)


def test_the_truth_goes_to_a_file(ros, tmp_path):
    path = tmp_path / "run" / "truth.jsonl"
    node = ros.add(BurgerNode, truth_file=str(path), **FAST)
    assert ros.spin_until(lambda: node.simulation.time >= 3.0)
    lines = [json.loads(line) for line in path.read_text().splitlines()[:20]]
    assert [line["time"] for line in lines] == pytest.approx([1.05 + 0.05 * n for n in range(20)])
    assert set(lines[0]) == {row.strip("` ") for cell in column("Truth") for row in cell.split(",")}


def test_a_second_of_the_truth_is_on_the_disk_when_it_is_over(tmp_path):
    file = TruthFile(tmp_path / "truth.jsonl")
    truth = BurgerSimulation(generate_maze(1, "demo")).truth
    for time in (1.5, 1.6, 2.5):
        file.write(replace(truth, time=time))
    lines = (tmp_path / "truth.jsonl").read_text().splitlines()
    assert [json.loads(line)["time"] for line in lines] == [1.5, 1.6, 2.5]
    file.close()


def column(heading: str) -> list[str]:
    return [row["member"] for row in table(README, heading)]


def of(select: Callable[[BurgerNode], Any], ros: Any) -> set[tuple[str, str, str]]:
    return endpoints(select(ros.add(BurgerNode, start_paused=True)))


def test_the_readme_lists_what_it_publishes_and_subscribes(ros):
    assert listed(README, "Publishes") == of(lambda node: node.publishers, ros)
    assert listed(README, "Subscribes") == of(lambda node: node.subscriptions, ros)


def test_the_readme_lists_the_parameters():
    rows = table(README, "Parameters of `burger_node`")
    options = BurgerOptions.__dataclass_fields__
    fields = [f for name, f in BurgerConfig.__dataclass_fields__.items() if name not in options]
    assert [row["parameter"] for row in rows] == [field.name for field in fields]
    for row, field in zip(rows, fields, strict=True):
        assert row["default"] == str(field.default)
        assert row["meaning"] == field.metadata["parameter"].description
