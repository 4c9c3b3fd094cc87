"""The lockstep: which answers are missing, and graph and loop alike."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import pytest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rover_interfaces.msg import SensorTick
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Float32MultiArray, Header, Int32, String
from test_simulation import written

from burger_simulator.lockstep import SETTLED, Lockstep, Settling
from burger_simulator.node import BurgerNode
from burger_simulator.simulation import BurgerSimulation
from burger_simulator.world.generator import generate_maze
from rover_common import topics
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.conversions import header_of
from rover_common.ros.runner import EventsExecutor
from rover_common.sensor_batches import BatchCollector
from rover_common.sensor_types import SensorBatch, Twist

EXECUTOR = EventsExecutor  # of the fixture `ros`
LAUNCH_TICK = 20
HEARD_BY_BOTH = (
    (LaserScan, topics.SCAN, qos.SCAN),
    (Imu, topics.IMU, qos.IMU),
    (Odometry, topics.ODOMETRY, qos.SENSOR),
    (SensorTick, topics.SENSOR_TICK, qos.SENSOR),
)


def controller(batch: SensorBatch) -> Twist:
    """Anything that depends on what was said."""
    pose = batch.odometry[-1].pose
    return Twist(0.1 + 0.05 * math.sin(10.0 * pose.x), 0.8 * math.cos(3.0 * pose.yaw))


class Peer(Node):
    """Navigator and mission: collects batches, and answers each."""

    def __init__(self, with_mission: bool = False, answers: bool = True, **kwargs: Any) -> None:
        super().__init__("peer", **kwargs)
        self.batches: list[SensorBatch] = []
        self.with_mission, self.answers = with_mission, answers
        self._collector = BatchCollector()
        collect = self._collector.add
        said: list[tuple[type, str, Any, Callable[[Any], None]]] = [
            (LaserScan, topics.SCAN, qos.SCAN, lambda m: collect(sensors.laser_scan_of(m))),
            (Imu, topics.IMU, qos.IMU, lambda m: collect(sensors.imu_of(m))),
            (Odometry, topics.ODOMETRY, qos.SENSOR,
             lambda m: collect(sensors.wheel_odometry_of(m))),
            (Float32MultiArray, topics.TEMPERATURE_1, qos.SENSOR,
             lambda m: collect(sensors.thermal_of(m, 0, 1))),
            (Float32MultiArray, topics.TEMPERATURE_2, qos.SENSOR,
             lambda m: collect(sensors.thermal_of(m, 0, 2))),
            (String, topics.FLYWHEEL_STATUS, qos.CONTROL, lambda _: self._collector.add_launch()),
            (SensorTick, topics.SENSOR_TICK, qos.SENSOR,
             lambda m: self._collector.add_tick(sensors.tick_of(m))),
        ]  # fmt: skip
        for kind, topic, profile, store in said:
            self.create_subscription(kind, topic, partial(self._on_message, store), profile)
        if with_mission:  # others, as of another node
            for kind, topic, profile in HEARD_BY_BOTH:
                self.create_subscription(kind, topic, lambda _: None, profile)
        self._cmd_vel = self.create_publisher(TwistStamped, topics.CMD_VEL, qos.CONTROL)
        self._tick = self.create_publisher(Header, topics.MISSION_TICK, qos.CONTROL)
        self._flywheel = self.create_publisher(Int32, topics.FLYWHEEL, qos.CONTROL)

    def _on_message(self, store: Callable[[Any], None], message: Any) -> None:
        store(message)
        batch = self._collector.take_complete()
        if batch is not None:
            self.batches.append(batch)
            if self.answers:
                self._answer(batch)

    def _answer(self, batch: SensorBatch) -> None:
        twist = controller(batch)
        self._cmd_vel.publish(sensors.stamped_twist_message_of(batch.stamp, twist))
        if self.with_mission:
            launch = len(self.batches) == LAUNCH_TICK
            frame = topics.FLYWHEEL if launch else ""
            self._tick.publish(header_of(batch.stamp, frame))
            if launch:  # later than what announces it
                self._flywheel.publish(Int32(data=50))


def loop(ticks: int, launch: bool) -> list[SensorBatch]:
    """The same without ROS."""
    simulation = BurgerSimulation(generate_maze(5), 5)
    batches = [simulation.step()]
    while len(batches) < ticks:
        batches.append(
            simulation.step(controller(batches[-1]), launch and len(batches) == LAUNCH_TICK)
        )
    return batches


@pytest.mark.parametrize("with_mission", [False, True])
def test_graph_and_loop_say_the_same_bit_for_bit(ros, with_mission):
    peer = ros.add(partial(Peer, with_mission))
    node = ros.add(BurgerNode, seed=5, lockstep=True, lockstep_with_mission=with_mission, rate=0.0)
    ticks = LAUNCH_TICK + 10 * 21 + 12
    assert ros.spin_until(lambda: len(peer.batches) >= ticks, timeout=60.0)
    batches = loop(ticks, launch=with_mission)
    assert written(peer.batches[:ticks]) == written(batches)
    assert sum(batch.launches_done for batch in batches) == with_mission
    assert len(node.simulation.truth.launches) == with_mission


def test_nothing_begins_without_the_peers(ros):
    node = ros.add(BurgerNode, lockstep=True, rate=0.0, answer_deadline=0.1)
    assert not ros.spin_until(lambda: node.simulation.time > 1.0, timeout=1.0)
    peer = ros.add(Peer)
    assert ros.spin_until(lambda: len(peer.batches) > 5)


def test_a_tick_that_is_not_answered_goes_on_standing(ros):
    peer = ros.add(Peer)
    node = ros.add(BurgerNode, lockstep=True, rate=0.0, answer_deadline=0.2)
    assert ros.spin_until(lambda: len(peer.batches) >= 20)
    assert node.simulation.truth.speed > 0.05
    peer.answers = False
    count = len(peer.batches)
    assert ros.spin_until(lambda: len(peer.batches) >= count + 8)
    assert abs(node.simulation.truth.speed) < 0.01
    assert node._diagnostics.counts["answers_missing"] >= 7


def test_the_mission_is_waited_for_as_well(ros):
    ros.add(Peer)  # navigates, and is no mission
    other = ros.add(lambda **kwargs: Node("mission", **kwargs))
    tick = other.create_publisher(Header, topics.MISSION_TICK, qos.CONTROL)
    node = ros.add(BurgerNode, lockstep=True, lockstep_with_mission=True, rate=0.0)
    for kind, topic, profile in HEARD_BY_BOTH:
        assert not ros.spin_until(lambda: node.simulation.time > 1.0, timeout=0.7)
        other.create_subscription(kind, topic, lambda _: None, profile)
    assert ros.spin_until(lambda: node.simulation.time > 1.0)
    assert not ros.spin_until(lambda: node.simulation.time > 1.06, timeout=0.5)
    tick.publish(header_of(node.simulation.stamp - 1, ""))  # of no tick
    assert not ros.spin_until(lambda: node.simulation.time > 1.06, timeout=0.5)
    assert node._diagnostics.counts["answers_late"] == 1
    tick.publish(header_of(node.simulation.stamp, ""))
    assert ros.spin_until(lambda: node.simulation.time > 1.06)


def test_the_rate_limits_a_lockstep(ros):
    peer = ros.add(Peer)
    ros.add(BurgerNode, lockstep=True, rate=0.2)  # four ticks a second
    assert ros.spin_until(lambda: peer.batches)
    assert not ros.spin_until(lambda: len(peer.batches) > 10, timeout=1.0)
    assert ros.spin_until(lambda: len(peer.batches) > 10)


def test_it_is_settled_when_nothing_has_changed_for_a_while():
    settling = Settling(0.5)
    assert not settling.settled((1, 1), 10.0)
    assert not settling.settled((1, 2), 10.4)
    assert not settling.settled((1, 2), 10.8)
    assert settling.settled((1, 2), 10.9)
    assert settling.settled((2, 2), 11.0)
    assert settling.done


def test_missing_answers_and_their_deadline():
    lockstep = Lockstep(("driver", "mission"), 5.0)
    assert lockstep.missing == []
    assert not lockstep.expired(1e9)
    lockstep.begin(100, 10.0)
    assert lockstep.missing == ["driver", "mission"]
    assert not lockstep.answer("driver", 99)
    assert lockstep.answer("driver", 100)
    assert lockstep.missing == ["mission"]
    assert not lockstep.expired(14.9)
    assert lockstep.expired(15.0)
    assert lockstep.answer("mission", 100)
    assert not lockstep.expired(15.0)
    lockstep.expect("flywheel")
    assert lockstep.missing == ["flywheel"]
    lockstep.arrived("flywheel")
    assert lockstep.missing == []
    lockstep.follow(1, 14.0)
    assert not lockstep.expired(15.0)
    lockstep.begin(150, 20.0)
    lockstep.follow(2, 21.0)
    assert not lockstep.expired(21.0 + SETTLED - 0.1)
    lockstep.follow(2, 21.0 + SETTLED - 0.1)
    assert lockstep.expired(21.0 + SETTLED)
    lockstep.begin(200, 30.0)
    lockstep.follow(1, 30.0)  # one has gone
    assert not lockstep.expired(34.9)
