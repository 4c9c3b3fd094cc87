"""The bridge node over a real socket: both protocols, garbage, reconnects, deadlines."""

from __future__ import annotations

import socket

import pytest
import socketio
import websocket
from telemetry import jpeg, telemetry
from wire_clients import Unity, answers_to, modern_answers, run_clients, unity_answers

from rover_bridge.node import BridgeNode
from rover_bridge.server import SocketServer
from rover_bridge.transport import PortInUseError
from rover_common.types import Command

REQUESTS = 200


def test_clients_of_both_protocols_at_once_get_an_answer_for_each_telemetry(ros, bridge):
    unity, modern = run_clients(
        ros,
        lambda: unity_answers(bridge.port, REQUESTS),
        lambda: modern_answers(bridge.port, REQUESTS),
    )
    assert len(unity) == len(modern) == REQUESTS
    for answer in (*unity, *modern):
        assert all(isinstance(value, str) for value in answer.values())
        assert {"steering_angle", "throttle", "brake"} <= set(answer)
    # One of them is the active client, the other one is answered with the brake.
    throttles = {answer["throttle"] for answer in unity}, {answer["throttle"] for answer in modern}
    assert {"0.2500"} in throttles


def test_the_decision_reaches_the_simulator(ros, bridge):
    (answers,) = run_clients(ros, lambda: unity_answers(bridge.port, 5))
    assert answers[0]["throttle"] == "0.2500"
    assert float(answers[0]["steering_angle"]) == pytest.approx(5.7296, abs=1e-3)
    assert answers[0]["brake"] == "0.0000"


def test_a_simulator_may_disconnect_and_connect_again(ros, bridge):
    for _ in range(3):
        (answers,) = run_clients(ros, lambda: unity_answers(bridge.port, 3))
        assert {answer["throttle"] for answer in answers} == {"0.2500"}


def test_without_a_decision_the_brake_answers(ros):
    node = ros.add(BridgeNode, port=0, answer_deadline=0.05)
    (answers,) = run_clients(ros, lambda: unity_answers(node.port, 3))
    assert {(answer["throttle"], answer["brake"]) for answer in answers} == {("0.0000", "1.0000")}


@pytest.mark.parametrize(
    "broken",
    [
        {"speed": "NaN"},
        {"position": ""},
        {"image": "!"},
        {"image": telemetry(image=jpeg(width=64, height=32))["image"]},
        {"sample_count": None},
    ],
    ids=lambda broken: str(broken)[:24],
)
def test_a_broken_telemetry_is_answered_with_the_brake_and_the_next_one_is_read(
    ros, bridge, broken
):
    events = answers_to(ros, bridge.port, telemetry(), telemetry() | broken, telemetry())
    assert [event.data["brake"] for event in events] == ["0.0000", "1.0000", "0.0000"]


def test_telemetry_that_is_no_object_is_answered(ros, bridge):
    def body() -> dict[str, str]:
        with socketio.SimpleClient() as client:
            client.connect(f"http://127.0.0.1:{bridge.port}", transports=["websocket"])
            client.emit("telemetry", "nonsense")
            return client.receive(timeout=10)[1]

    (answer,) = run_clients(ros, body)
    assert answer["brake"] == "1.0000"


def test_a_message_beyond_the_librarys_default_size(ros, bridge):
    (event,) = answers_to(ros, bridge.port, telemetry() | {"padding": "x" * 2_000_000})
    assert event.name == "data"


def test_pings_of_a_legacy_client_are_answered(ros, bridge):
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
        answers = unity_answers(bridge.port, 3)
        raw.shutdown()
        return answers

    (answers,) = run_clients(ros, body)
    assert len(answers) == 3


def test_a_port_in_use_is_one_clear_error():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(PortInUseError, match=str(port)):
            SocketServer("127.0.0.1", port, lambda event: None)


def test_a_pickup_is_sent_once_and_then_the_brake(ros, bridge):
    bridge.decider.command = Command(brake=1.0, pickup=True)
    states = [
        {"near_sample": False},
        {"near_sample": True, "speed": 1.0},
        {"near_sample": True},
        {"near_sample": True},  # sent before the simulator took the pickup
        {"near_sample": True, "picking_up": True},
    ]
    events = answers_to(ros, bridge.port, *(telemetry(**state) for state in states))
    assert [event.name for event in events] == ["data", "data", "pickup", "data", "data"]
    assert events[2].data == {}
    assert all(event.data["brake"] == "1.0000" for event in events if event.name == "data")


def test_a_decimal_comma_is_answered_with_one(ros, bridge):
    (event,) = answers_to(ros, bridge.port, telemetry(decimal=","))
    assert event.data["throttle"] == "0,2500"


def test_one_odd_comma_does_not_count_for_the_next_telemetry(ros, bridge):
    frames = telemetry(), telemetry(decimal=","), telemetry(), telemetry() | {"speed": "0"}
    events = answers_to(ros, bridge.port, *frames)
    assert [event.data["throttle"][1] for event in events] == [".", ",", ".", "."]


def test_a_flood_is_answered_telemetry_by_telemetry(ros, bridge):
    count = 200

    def body() -> int:
        with Unity(bridge.port) as unity:
            for _ in range(count):
                unity.send(telemetry())
            answers = 0
            while answers < count and unity.next_answer():
                answers += 1
            assert unity.next_answer(timeout=0.5) is None
            return answers

    assert run_clients(ros, body) == [count]
