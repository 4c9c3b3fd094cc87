"""The bridge node over a real socket: both dialects, garbage, reconnects, deadlines."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from typing import Any

import pytest
import socketio
import websocket
from rclpy.node import Node
from rover_interfaces.msg import DriveCommand, RoverStatus
from telemetry import jpeg, telemetry

from rover_bridge.node import BridgeNode
from rover_bridge.server import PortInUseError, SocketServer
from rover_common import topics
from rover_common.ros import conversions, qos
from rover_common.types import FIRST_RUN, Command
from rover_simulator.wire.unity_client import OPEN, UnityClient

EXCHANGES = 1000
COMMAND = Command(throttle=0.25, steering_angle=0.1)


class Decider(Node):
    """Answers every status at once."""

    def __init__(self, command: Command = COMMAND, **kwargs: Any) -> None:
        super().__init__("decider", **kwargs)
        self._command = command
        self._publisher = self.create_publisher(DriveCommand, topics.COMMAND, qos.FRAME)
        self.create_subscription(RoverStatus, topics.STATUS, self._on_status, qos.FRAME)

    def _on_status(self, status: RoverStatus) -> None:
        stamp = conversions.stamp_of(status.header.stamp)
        self._publisher.publish(conversions.command_message_of(0, stamp, FIRST_RUN, self._command))


class InThread:
    """Runs a client beside the executor and keeps what it returned or raised."""

    def __init__(self, body: Callable[[], Any]) -> None:
        self.result: Any = None
        self.error: BaseException | None = None

        def run() -> None:
            try:
                self.result = body()
            except BaseException as error:
                self.error = error

        self._thread = threading.Thread(target=run)
        self._thread.start()

    def done(self) -> bool:
        return not self._thread.is_alive()

    def get(self) -> Any:
        self._thread.join()
        if self.error is not None:
            raise self.error
        return self.result


@pytest.fixture
def bridge(ros):
    node = ros.add(BridgeNode, port=0, answer_deadline=0.3)
    decider = ros.add(Decider)
    assert ros.spin_until(lambda: node.count_subscribers(topics.COMMAND) > 0)
    assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)
    return node


def run_clients(ros, *bodies: Callable[[], Any]) -> list[Any]:
    clients = [InThread(body) for body in bodies]
    assert ros.spin_until(lambda: all(client.done() for client in clients), timeout=120)
    return [client.get() for client in clients]


def unity_exchanges(port: int, count: int) -> list[dict[str, str]]:
    """The simulator's way: a telemetry when the socket opens, one on the open packet, then one
    for each answer; at the end all answers are waited for."""
    client = UnityClient("127.0.0.1", port)
    client.connect(timeout=5)
    answers: list[dict[str, str]] = []
    client.send_telemetry(telemetry())
    sent = 1
    try:
        while len(answers) < count:
            event = client.receive(timeout=10)
            assert event is not None, f"no answer after {len(answers)} of {sent}"
            if event.name != OPEN:
                assert event.name == "data"
                answers.append(dict(event.data))
            if sent < count:
                client.send_telemetry(telemetry())
                sent += 1
        assert client.receive(timeout=0.5) is None, "more answers than telemetries"
    finally:
        client.close(say_goodbye=True)
    return answers


def modern_exchanges(port: int, count: int) -> list[dict[str, str]]:
    """python-socketio's own client of the fifth generation."""
    answers = []
    with socketio.SimpleClient() as client:
        client.connect(f"http://127.0.0.1:{port}", transports=["websocket"])
        for _ in range(count):
            client.emit("telemetry", telemetry())
            name, data = client.receive(timeout=10)
            assert name == "data"
            answers.append(data)
        with pytest.raises(socketio.exceptions.TimeoutError):
            client.receive(timeout=0.5)
    return answers


def test_both_generations_at_once_get_an_answer_for_each_telemetry(ros, bridge):
    unity, modern = run_clients(
        ros,
        lambda: unity_exchanges(bridge.port, EXCHANGES),
        lambda: modern_exchanges(bridge.port, EXCHANGES),
    )
    assert len(unity) == len(modern) == EXCHANGES
    for answer in (*unity, *modern):
        assert all(isinstance(value, str) for value in answer.values())
        assert {"steering_angle", "throttle", "brake"} <= set(answer)
    # One of them drives; the other one is held by the brake.
    driven = {answer["throttle"] for answer in unity}, {answer["throttle"] for answer in modern}
    assert {"0.2500"} in driven


def test_the_decision_reaches_the_simulator(ros, bridge):
    (answers,) = run_clients(ros, lambda: unity_exchanges(bridge.port, 5))
    assert answers[0]["throttle"] == "0.2500"
    assert float(answers[0]["steering_angle"]) == pytest.approx(5.7296, abs=1e-3)
    assert answers[0]["brake"] == "0.0000"


def test_a_simulator_may_leave_and_come_back(ros, bridge):
    for _ in range(3):
        (answers,) = run_clients(ros, lambda: unity_exchanges(bridge.port, 3))
        assert {answer["throttle"] for answer in answers} == {"0.2500"}


def test_without_a_decision_the_brake_answers(ros):
    node = ros.add(BridgeNode, port=0, answer_deadline=0.05)
    (answers,) = run_clients(ros, lambda: unity_exchanges(node.port, 3))
    assert {(answer["throttle"], answer["brake"]) for answer in answers} == {("0.0000", "1.0000")}


@pytest.mark.parametrize(
    "broken",
    [
        {"speed": "NaN"},
        {"position": ""},
        {"image": "!"},
        {"sample_count": None},
    ],
)
def test_a_broken_telemetry_is_answered_and_the_exchange_goes_on(ros, bridge, broken):
    def body() -> list[str]:
        client = UnityClient("127.0.0.1", bridge.port)
        client.connect(timeout=5)
        brakes = []
        for wire in (telemetry(), telemetry() | broken, telemetry()):
            client.send_telemetry(wire)
            while (event := client.receive(timeout=10)) and event.name == OPEN:
                pass
            assert event is not None
            brakes.append(event.data["brake"])
        client.close()
        return brakes

    (brakes,) = run_clients(ros, body)
    assert brakes == ["0.0000", "1.0000", "0.0000"]


def test_telemetry_that_is_no_object_is_answered(ros, bridge):
    def body() -> dict[str, str]:
        with socketio.SimpleClient() as client:
            client.connect(f"http://127.0.0.1:{bridge.port}", transports=["websocket"])
            client.emit("telemetry", "nonsense")
            return client.receive(timeout=10)[1]

    (answer,) = run_clients(ros, body)
    assert answer["brake"] == "1.0000"


def test_a_message_beyond_the_librarys_default_size(ros, bridge):
    def body() -> int:
        client = UnityClient("127.0.0.1", bridge.port)
        client.connect(timeout=5)
        client.send_telemetry(telemetry() | {"padding": "x" * 2_000_000})
        answers = 0
        while not answers:
            event = client.receive(timeout=20)
            assert event is not None
            answers += event.name == "data"
        client.close()
        return answers

    assert run_clients(ros, body) == [1]


def test_pings_of_the_older_generation_are_answered(ros, bridge):
    def body() -> list[str]:
        raw = websocket.create_connection(
            f"ws://127.0.0.1:{bridge.port}/socket.io/?EIO=3&transport=websocket",
            suppress_origin=True,
            timeout=5,
        )
        raw.send("2")
        received = [str(raw.recv()) for _ in range(3)]
        raw.close()
        return received

    (received,) = run_clients(ros, body)
    assert received[0].startswith("0{")
    assert "3" in received


@pytest.mark.parametrize("garbage", ["", "hello", "42[", "4", "9", "42{}", "451-[]", "\x00\xff"])
def test_garbage_on_the_socket_does_not_hurt_others(ros, bridge, garbage):
    def body() -> list[dict[str, str]]:
        raw = websocket.create_connection(
            f"ws://127.0.0.1:{bridge.port}/socket.io/?EIO=4&transport=websocket", timeout=5
        )
        raw.send(garbage)
        answers = unity_exchanges(bridge.port, 3)
        raw.shutdown()
        return answers

    (answers,) = run_clients(ros, body)
    assert len(answers) == 3


def test_one_stamp_for_all_that_came_in_one_telemetry(ros, bridge):
    from nav_msgs.msg import Odometry
    from sensor_msgs.msg import CameraInfo, Image

    got: dict[str, list[Any]] = {}
    watcher = ros.add(lambda **kwargs: Node("watcher", **kwargs))
    kinds = {
        topics.IMAGE: Image,
        topics.CAMERA_INFO: CameraInfo,
        topics.ODOMETRY: Odometry,
        topics.STATUS: RoverStatus,
    }
    for topic, kind in kinds.items():
        got[topic] = []
        watcher.create_subscription(kind, topic, got[topic].append, qos.FRAME)
    assert ros.spin_until(lambda: all(watcher.count_publishers(topic) for topic in kinds))
    run_clients(ros, lambda: unity_exchanges(bridge.port, 2))
    assert ros.spin_until(lambda: all(len(messages) == 2 for messages in got.values()))
    for messages in zip(*got.values(), strict=True):
        assert len({conversions.stamp_of(message.header.stamp) for message in messages}) == 1
    image, info, odometry, status = (got[topic][0] for topic in kinds)
    assert (image.height, image.width, image.encoding) == (160, 320, "rgb8")
    assert info.k[0] == pytest.approx(114.25, abs=0.01)
    assert odometry.pose.pose.position.x == pytest.approx(99.67)
    assert odometry.child_frame_id == "base_link"
    assert status.sample_count == 2
    assert list(status.sample_x) == pytest.approx([109.78, 62.63])


def test_simulated_time_becomes_the_stamp_and_the_clock(ros, bridge):
    from rosgraph_msgs.msg import Clock

    clocks: list[Clock] = []
    stamps: list[int] = []
    watcher = ros.add(lambda **kwargs: Node("watcher", **kwargs))
    watcher.create_subscription(Clock, "/clock", clocks.append, qos.CLOCK)
    watcher.create_subscription(
        RoverStatus,
        topics.STATUS,
        lambda message: stamps.append(conversions.stamp_of(message.header.stamp)),
        qos.FRAME,
    )
    assert ros.spin_until(lambda: watcher.count_publishers("/clock"))
    assert ros.spin_until(lambda: watcher.count_publishers(topics.STATUS))

    def body() -> None:
        client = UnityClient("127.0.0.1", bridge.port)
        client.connect(timeout=5)
        for time in (7.5, 7.5, 8.0):
            client.send_telemetry(telemetry(sim_time=time))
            while (event := client.receive(timeout=10)) and event.name == OPEN:
                pass
        client.close()

    run_clients(ros, body)
    assert ros.spin_until(lambda: len(stamps) == 3)
    assert stamps == [7_500_000_000, 7_500_000_001, 8_000_000_000]
    assert ros.spin_until(lambda: clocks)


def test_a_port_in_use_is_one_clear_error():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(PortInUseError, match=str(port)):
            SocketServer("127.0.0.1", port, lambda event: None)


def test_the_image_size_is_told(ros, bridge):
    def body() -> str:
        client = UnityClient("127.0.0.1", bridge.port)
        client.connect(timeout=5)
        client.send_telemetry(telemetry(image=jpeg(width=64, height=32)))
        while (event := client.receive(timeout=10)) and event.name == OPEN:
            pass
        client.close()
        assert event is not None
        return str(event.data["brake"])

    assert run_clients(ros, body) == ["1.0000"]


def test_a_pickup_goes_out_once_and_then_the_brake(ros):
    node = ros.add(BridgeNode, port=0, answer_deadline=5.0)
    decider = ros.add(lambda **kwargs: Decider(Command(brake=1.0, pickup=True), **kwargs))
    assert ros.spin_until(lambda: node.count_subscribers(topics.COMMAND) > 0)
    assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)
    states = [
        {"near_sample": False},
        {"near_sample": True, "speed": 1.0},
        {"near_sample": True},
        {"near_sample": True},  # was in flight already
        {"near_sample": True, "picking_up": True},
    ]

    def body() -> list[tuple[str, dict[str, str]]]:
        client = UnityClient("127.0.0.1", node.port)
        client.connect(timeout=5)
        answers = []
        for state in states:
            client.send_telemetry(telemetry(**state))
            while (event := client.receive(timeout=10)) and event.name == OPEN:
                pass
            assert event is not None
            answers.append((event.name, dict(event.data)))
        client.close()
        return answers

    (answers,) = run_clients(ros, body)
    assert [name for name, _ in answers] == ["data", "data", "pickup", "data", "data"]
    assert answers[2][1] == {}
    assert all(data["brake"] == "1.0000" for name, data in answers if name == "data")


def test_a_decimal_comma_is_answered_with_one(ros, bridge):
    def body() -> dict[str, str]:
        client = UnityClient("127.0.0.1", bridge.port)
        client.connect(timeout=5)
        client.send_telemetry(telemetry(decimal=","))
        while (event := client.receive(timeout=10)) and event.name == OPEN:
            pass
        client.close()
        assert event is not None
        return dict(event.data)

    (answer,) = run_clients(ros, body)
    assert answer["throttle"] == "0,2500"


def test_a_flood_is_answered_telemetry_by_telemetry(ros, bridge):
    count = 200

    def body() -> int:
        client = UnityClient("127.0.0.1", bridge.port)
        client.connect(timeout=5)
        for _ in range(count):
            client.send_telemetry(telemetry())
        answers = 0
        while answers < count and (event := client.receive(timeout=10)):
            answers += event.name == "data"
        assert client.receive(timeout=0.5) is None
        client.close()
        return answers

    assert run_clients(ros, body) == [count]
