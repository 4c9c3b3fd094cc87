"""Whatever a simulator sends as its telemetry is decoded or refused, and answered once."""

from __future__ import annotations

import json
from typing import Any

from cases import CASES, WIRE_CASES, fuzzed
from hostile_wire import JSON, PAYLOADS
from hypothesis import given
from hypothesis import strategies as st
from readers import assert_finite
from telemetry import telemetry
from wire_clients import QUIET, Decider, InThread, Unity

from rover_bridge.codec import decimal_mark, decode_telemetry, shows_insets
from rover_bridge.errors import TelemetryError
from rover_bridge.node import BridgeNode
from rover_bridge.wire_format import WireError, WirePacket, check_packet
from rover_common import topics


@fuzzed(CASES * 0.25)
@given(PAYLOADS)
def test_a_telemetry_is_decoded_to_finite_numbers_or_refused_with_its_defect(wire):
    shows_insets(wire)
    decimal_mark(wire)
    try:
        decoded = decode_telemetry(wire)
    except TelemetryError as error:
        assert error.counter
    else:
        assert_finite(decoded)


@fuzzed(CASES * 0.1)
@given(st.one_of(st.text(max_size=30), JSON.map(lambda v: "42" + json.dumps(["telemetry", v]))))
def test_a_packet_is_read_or_refused(text):
    try:
        check_packet(text)
        if text.startswith("4"):
            WirePacket(encoded_packet=text[1:])
    except (WireError, ValueError):  # which is what the server takes for garbage
        pass


def test_every_telemetry_over_the_wire_has_one_answer(ros):
    bridge = ros.add(BridgeNode, port=0, answer_deadline=5.0)
    decider = ros.add(Decider)
    assert ros.spin_until(lambda: bridge.count_subscribers(topics.COMMAND) > 0)
    assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)

    def body() -> None:
        with Unity(bridge.port) as unity:
            assert unity.ask(telemetry()).name == "data"

            @fuzzed(WIRE_CASES)
            @given(PAYLOADS)
            def wire_case(payload: Any) -> None:
                unity._client._send("42" + json.dumps(["telemetry", payload]))
                answer = unity.next_answer()
                assert answer is not None, payload
                assert answer.name in ("data", "pickup")

            wire_case()
            assert unity.ask(telemetry()).data["throttle"] == "0.2500"
            assert unity.next_answer(QUIET) is None  # none had two

    client = InThread(body)
    assert ros.spin_until(client.done, timeout=120.0 + WIRE_CASES)
    client.get()
    assert not [key for key in bridge.counts if key.startswith("failed")]
