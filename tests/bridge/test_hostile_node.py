"""The bridge node beside clients that harm: each telemetry has one answer, a brake its reason."""

from __future__ import annotations

import base64
import json
from collections import Counter as Counts
from typing import Any

import pytest
import websocket
from telemetry import IMAGE, picture_bomb, telemetry
from wire_clients import QUIET, Unity, answers_to, run_clients

from rover_bridge import active_client
from rover_bridge.counters import Counter
from rover_bridge.node_publishers import TelemetryPublishers


def counts(bridge: Any) -> Counts[str]:
    return bridge.node._diagnostics.counts


@pytest.mark.parametrize(
    ("image", "reason"),
    [
        (picture_bomb(), "image is 32760 x 32760 pixels"),
        (base64.b64encode(IMAGE[:2500] + b"\xff\xd9").decode(), "before its last row"),
    ],
    ids=["claims_much", "cut_short"],
)
def test_a_picture_that_cannot_be_used_is_answered_with_the_brake_and_the_reason(
    ros, bridge, image, reason
):
    wires = telemetry(), telemetry() | {"image": image}, telemetry()
    events = answers_to(ros, bridge.port, *wires)
    assert [event.data["brake"] for event in events] == ["0.0000", "1.0000", "0.0000"]
    assert reason in events[1].data["refused"]
    assert "refused" not in events[0].data


@pytest.mark.parametrize("digits", [310, 5000])
def test_an_integer_of_many_digits_is_answered(ros, bridge, digits):
    text = json.dumps(["telemetry", telemetry() | {"speed": 0}])
    text = text.replace('"speed": 0', '"speed": ' + "9" * digits)

    def body() -> list[str]:
        url = f"ws://127.0.0.1:{bridge.port}/socket.io/?EIO=4&transport=websocket"
        raw = websocket.create_connection(url, timeout=60)
        raw.send("42" + text)
        received = [str(raw.recv())]
        while not received[-1].startswith("42"):
            received.append(str(raw.recv()))
        raw.shutdown()
        return received

    (received,) = run_clients(ros, body)
    assert '"brake":"1.0000"' in received[-1]
    assert counts(bridge)["telemetry_not_finite"] == 1


def test_a_second_simulator_is_told_why_it_brakes(ros, bridge):
    def body() -> tuple[Any, Any, Any]:
        with Unity(bridge.port) as first, Unity(bridge.port) as second:
            return first.ask(telemetry()), second.ask(telemetry()), first.ask(telemetry())

    ((first, second, third),) = run_clients(ros, body)
    assert second.data["refused"] == "another client is active: braking"
    assert second.data["brake"] == "1.0000"
    assert "refused" not in {**first.data, **third.data}


def test_a_client_that_waits_does_not_become_active_while_the_simulator_pauses(
    ros, bridge, monkeypatch
):
    monkeypatch.setattr(active_client, "SILENCE", 0.1)

    def body() -> list[bool]:
        with Unity(bridge.port) as waiting:
            waiting.ask({})  # connected, and known by an event
            with Unity(bridge.port) as simulator:
                simulator.ask(telemetry())
                assert waiting.next_answer(timeout=0.3) is None  # a pause of the simulator
                refused = ["refused" in waiting.ask(telemetry()).data for _ in range(3)]
                return [*refused, "refused" in simulator.ask(telemetry()).data]

    assert run_clients(ros, body) == [[True, True, True, False]]
    assert counts(bridge)[Counter.TAKEOVERS] == 0
    assert {status.run for status in bridge.decider.statuses} == {1}


def test_a_simulator_that_was_reloaded_takes_over_and_the_counter_says_so(ros, bridge, monkeypatch):
    monkeypatch.setattr(active_client, "SILENCE", 0.1)

    def body() -> bool:
        with Unity(bridge.port) as left_open:
            left_open.ask(telemetry())
            with Unity(bridge.port) as reloaded:
                assert reloaded.next_answer(timeout=0.3) is None
                return "refused" in reloaded.ask(telemetry()).data

    assert run_clients(ros, body) == [False]
    assert counts(bridge)[Counter.TAKEOVERS] == 1
    assert ros.spin_until(lambda: len(bridge.decider.statuses) == 2)
    assert {status.run for status in bridge.decider.statuses} == {1}


def test_a_client_without_a_good_telemetry_never_becomes_active(ros, bridge):
    def body() -> tuple[Any, Any]:
        with Unity(bridge.port) as noise, Unity(bridge.port) as simulator:
            return noise.ask({"speed": "noise"}), simulator.ask(telemetry())

    ((noise, answer),) = run_clients(ros, body)
    assert "no 'sample_count'" in noise.data["refused"]
    assert "refused" not in answer.data


def test_an_event_named_disconnect_loses_no_answer(ros, bridge):
    def body() -> list[str]:
        with Unity(bridge.port) as unity:
            unity.ask(telemetry())
            unity.send(telemetry())
            unity._client._send('42["disconnect"]')
            answer = unity.next_answer()
            assert answer is not None
            assert unity.next_answer(timeout=QUIET) is None
            return [answer.data["throttle"], unity.ask(telemetry()).data["throttle"]]

    assert run_clients(ros, body) == [["0.2500", "0.2500"]]


def test_a_defect_of_the_node_is_answered_once(ros, bridge, monkeypatch):
    def publish(*_: object) -> None:
        raise OverflowError("no such message")

    def body() -> Any:
        with Unity(bridge.port) as unity:
            answer = unity.ask(telemetry())
            assert unity.next_answer(timeout=QUIET) is None
            return answer

    with monkeypatch.context() as patched:
        patched.setattr(TelemetryPublishers, "publish", publish)
        (answer,) = run_clients(ros, body)
    assert answer.data["brake"] == "1.0000"
    assert "no such message" in answer.data["refused"]
    assert counts(bridge)[Counter.FAILED] == 1
    (event,) = answers_to(ros, bridge.port, telemetry())
    assert event.data["throttle"] == "0.2500"
