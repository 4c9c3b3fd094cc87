"""Who drives at the bridge's node, over a real socket; and a velocity in the simulator."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, TwistStamped, Vector3
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import String
from telemetry import telemetry
from wire_clients import DRIVE, InThread, Unity, run_clients

from rover_bridge.arbiter import TIMEOUT
from rover_bridge.codec import encode_drive
from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_common.types import SAFE_COMMAND
from rover_simulator.run import frame_steps_of
from rover_simulator.simulation import Simulation
from rover_simulator.wire.pacing import LockstepPacing, run_connected
from rover_simulator.wire.unity_client import UnityClient
from rover_simulator.world.generator import generate_world

OF_DECISION = {key: encode_drive(DRIVE)[key] for key in ("throttle", "steering_angle")}


def twist(linear: float, angular: float = 0.0) -> Twist:
    return Twist(linear=Vector3(x=linear), angular=Vector3(z=angular))


class Person(Node):
    """Publishes velocities, and hears who drives."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("person", **kwargs)
        self.drivers: list[str] = []
        self.create_subscription(
            String, topics.DRIVER, lambda m: self.drivers.append(m.data), qos.LATCHED
        )

    def connect(self, ros: Any, topic: str, kind: type = Twist) -> Any:
        """A publisher that the bridge has found."""
        publisher = self.create_publisher(kind, topic, qos.CONTROL)
        assert ros.spin_until(lambda: publisher.get_subscription_count() > 0)
        return publisher


@pytest.fixture
def person(ros) -> Person:
    return ros.add(Person)


def ask(ros: Any, unity: Unity, time: float) -> dict[str, str]:
    """The answer to a telemetry of a standing rover at this time [s]."""
    (event,) = run_clients(ros, lambda: unity.ask(telemetry(sim_time=time)))
    return dict(event.data)


def tell(ros: Any, node: BridgeNode, publisher: Any, message: Any) -> None:
    """Publish, and spin until the bridge has heard it."""
    heard = node._drivers._arbiter._heard
    before = dict(heard)
    heard.clear()
    publisher.publish(message)
    assert ros.spin_until(lambda: bool(heard))
    heard.update({key: value for key, value in before.items() if key not in heard})


def of_decision(answer: dict[str, str]) -> bool:
    return answer.items() >= OF_DECISION.items()


def test_a_velocity_drives_instead_of_the_mission_until_its_timeout(ros, bridge, person):
    velocity = person.connect(ros, topics.CMD_VEL)
    with Unity(bridge.port) as unity:
        assert of_decision(ask(ros, unity, 1.0))
        tell(ros, bridge.node, velocity, twist(1.0))
        answer = ask(ros, unity, 1.0 + TIMEOUT - 0.1)
        assert float(answer["throttle"]) == 1.0
        assert float(answer["steering_angle"]) == 0.0
        assert of_decision(ask(ros, unity, 1.0 + TIMEOUT + 0.1))
    # Between the timeout and decision's next command it may be nobody for a moment.
    assert ros.spin_until(
        lambda: (
            [each for each in person.drivers if each != "nobody"][-3:]
            == ["decision", "cmd_vel", "decision"]
        )
    )


def test_a_person_comes_first(ros, bridge, person):
    teleop, velocity = (person.connect(ros, t) for t in (topics.CMD_VEL_TELEOP, topics.CMD_VEL))
    with Unity(bridge.port) as unity:
        ask(ros, unity, 1.0)
        tell(ros, bridge.node, teleop, twist(0.0, 0.3))
        tell(ros, bridge.node, velocity, twist(1.0))
        answer = ask(ros, unity, 1.1)
        assert float(answer["throttle"]) == 0.0
        assert float(answer["steering_angle"]) == pytest.approx(math.degrees(0.1), abs=0.01)
    assert ros.spin_until(lambda: person.drivers[-1:] == ["manual"])


def test_a_velocity_that_is_not_finite_brakes(ros, bridge, person):
    velocity = person.connect(ros, topics.CMD_VEL)
    with Unity(bridge.port) as unity:
        ask(ros, unity, 1.0)
        tell(ros, bridge.node, velocity, twist(math.inf))
        assert float(ask(ros, unity, 1.1)["brake"]) == 1.0


def test_stamped_velocities_are_taken_where_the_parameter_says_so(ros, person):
    node = ros.add(BridgeNode, port=0, enable_stamped_cmd_vel=True)
    velocity = person.connect(ros, topics.CMD_VEL, TwistStamped)
    with Unity(node.port) as unity:
        ask(ros, unity, 1.0)
        tell(ros, node, velocity, TwistStamped(twist=twist(1.0)))
        assert float(ask(ros, unity, 1.1)["throttle"]) == 1.0


def test_a_velocity_of_the_other_type_is_an_error_in_the_diagnostics(ros, other_ros, bridge):
    other = other_ros.add(Person)
    other.create_publisher(TwistStamped, topics.CMD_VEL, qos.CONTROL)
    arrays: list[DiagnosticArray] = []
    watcher = ros.add(lambda **kwargs: Node("watcher", **kwargs))
    watcher.create_subscription(DiagnosticArray, "/diagnostics", arrays.append, qos.DIAGNOSTICS)

    def texts() -> list[str]:
        return [s.message for a in arrays for s in a.status if s.name == "/bridge_node"]

    assert ros.spin_until(lambda: any("sends geometry_msgs/msg/TwistStamped" in t for t in texts()))


def test_without_a_mission_it_stands_at_once_and_keeps_the_odometry_coming(ros, person):
    node = ros.add(BridgeNode, port=0, answer_deadline=60.0)
    person.connect(ros, topics.CMD_VEL)
    with Unity(node.port) as unity:
        answer = ask(ros, unity, 1.0)
    assert answer["brake"] == encode_drive(SAFE_COMMAND)["brake"]
    assert ros.spin_until(lambda: person.drivers == ["nobody"])


# In the embedded simulator

WANTED, SECONDS = (1.0, 0.3), 5.0  # [m/s], [rad/s], and for how long [s] it is said


class Navigator(Node):
    """Says the wanted velocity at every odometry, for some time, then nothing."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("navigator", **kwargs)
        self.seen: list[tuple[float, Pose, float]] = []  # time [s], pose, speed [m/s]
        self.velocity = self.create_publisher(Twist, topics.CMD_VEL, qos.CONTROL)
        self.create_subscription(Odometry, topics.ODOMETRY, self._on_odometry, qos.FRAME)

    def _on_odometry(self, message: Odometry) -> None:
        time = conversions.stamp_of(message.header.stamp) * 1e-9
        speed = message.twist.twist.linear.x
        self.seen.append((time, conversions.pose_of(message), speed))
        if time - self.seen[0][0] <= SECONDS:
            self.velocity.publish(twist(*WANTED))


def driven(ros: Any, node: BridgeNode, seconds: float) -> None:
    """Simulate so long [s] with the bridge's answers."""
    simulation = Simulation(generate_world(1, 0.4), 1, frame_steps_of(25.0))
    end = simulation.time + seconds

    def body() -> None:
        pacing = LockstepPacing(simulation, lambda: None)
        run_connected(UnityClient("127.0.0.1", node.port), pacing, over)

    over: Callable[[], bool] = lambda: simulation.time >= end  # noqa: E731
    client = InThread(body)
    assert ros.spin_until(client.done, timeout=120)
    client.get()


def test_a_velocity_is_reached_and_after_its_last_message_the_rover_stands(ros):
    node = ros.add(BridgeNode, port=0, answer_deadline=60.0)
    navigator = ros.add(Navigator)
    assert ros.spin_until(lambda: navigator.velocity.get_subscription_count() > 0)
    assert ros.spin_until(lambda: navigator.count_publishers(topics.ODOMETRY) > 0)
    driven(ros, node, SECONDS + 1.5)
    start = navigator.seen[0][0]
    steady = [each for each in navigator.seen if 3.0 < each[0] - start < SECONDS]
    assert [speed for *_, speed in steady] == pytest.approx([WANTED[0]] * len(steady), abs=0.05)
    rates = [
        math.remainder(b[1].yaw - a[1].yaw, 2 * math.pi) / (b[0] - a[0])
        for a, b in pairwise(steady)
    ]
    assert sum(rates) / len(rates) == pytest.approx(WANTED[1], abs=0.02)
    last = start + SECONDS
    after = [abs(speed) for time, _, speed in navigator.seen if time > last + TIMEOUT + 0.5]
    assert after
    assert max(after) == 0.0
