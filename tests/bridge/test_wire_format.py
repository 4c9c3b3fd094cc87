"""What a packet may look like, and how its JSON is read."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from telemetry import telemetry

from rover_bridge.wire_format import (
    MAX_VALUES,
    WireError,
    WirePacket,
    check_packet,
    read_json,
)

JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=9),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=12,
)


@pytest.mark.parametrize(
    "text", ["1", "2", "3", "2probe", "3probe", "5", "6", "40", "41", "40/other,", "430[]"]
)
def test_packets_of_both_protocols_pass(text):
    check_packet(text)


def test_a_telemetry_passes():
    check_packet("42" + json.dumps(["telemetry", telemetry()]))


@pytest.mark.parametrize(
    "text",
    ["", "0{}", "7", "hello", "4", "44", "451-[]", "461-[]", "4{}", "b4AAA", "\x00", "d=42", b"42"],
)
def test_other_packets_do_not(text):
    with pytest.raises(WireError):
        check_packet(text)


@pytest.mark.parametrize(
    "text", ["2" + "x" * 1000, "42[" + "1," * MAX_VALUES + "1]", "42" + "[" * (MAX_VALUES + 1)]
)
def test_packets_that_take_long_to_parse_do_not(text):
    with pytest.raises(WireError):
        check_packet(text)


@given(st.text(max_size=40) | st.binary(max_size=40))
def test_any_text_passes_or_is_an_error(text):
    try:
        check_packet(text)
    except WireError:
        return
    assert text[0] in "123456"


@given(JSON)
def test_json_is_read_as_the_library_reads_it(value):
    text = json.dumps(value)
    assert read_json(text) == json.loads(text)


@pytest.mark.parametrize("digits", [310, 5000, 100_000])
def test_an_integer_of_any_length_is_read(digits):
    assert read_json("-" + "9" * digits) == -math.inf


def test_too_many_levels_are_an_error():
    with pytest.raises(WireError):
        read_json("[" * 100_000)


def test_the_servers_packets_are_read_so():
    packet = WirePacket(encoded_packet='2["telemetry",{"speed":' + "9" * 5000 + "}]")
    assert packet.data == ["telemetry", {"speed": math.inf}]
