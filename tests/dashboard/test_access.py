"""Who may connect, and what may be asked for."""

from __future__ import annotations

import json
import socket

import pytest

from rover_dashboard.access import is_own_host, is_own_origin
from rover_dashboard.protocol import (
    SETTABLE,
    Ask,
    MissionRequest,
    ParameterChange,
    PlaybackChange,
    ProtocolError,
    parse,
)


@pytest.mark.parametrize(
    "host",
    ["127.0.0.1:8080", "localhost:8080", "[::1]:8080", "192.168.1.7", socket.gethostname()],
)
def test_a_host_of_this_machine_is_accepted(host):
    assert is_own_host(host, "127.0.0.1")


@pytest.mark.parametrize(
    "host",
    [None, "", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example",
     "evil.example@127.0.0.1", "127.0.0.1/evil", "localhost:port", "[::1"],
)  # fmt: skip
def test_a_name_that_others_made_is_refused(host):
    assert not is_own_host(host, "127.0.0.1")


def test_the_name_that_it_listens_on_is_accepted():
    assert is_own_host("Rover.lab:8080", "rover.lab")


@pytest.mark.parametrize(
    ("origin", "own"),
    [
        ("http://127.0.0.1:8080", True),
        (None, False),
        ("", False),
        ("null", False),
        ("http://127.0.0.1:9090", False),
        ("http://localhost:8080", False),
        ("https://127.0.0.1:8080", False),
        ("http://evil.example", False),
        ("http://127.0.0.1:8080.evil.example", False),
    ],
)
def test_only_the_pages_own_origin_is_accepted(origin, own):
    assert is_own_origin(origin, "127.0.0.1:8080") is own


def test_a_request_and_a_parameter_are_read():
    assert parse('{"id": 1, "request": "pause"}') == Ask(1, MissionRequest("pause"))
    speed = Ask(2, ParameterChange("top_speed", 2.0))
    assert parse('{"id": 2, "set": "top_speed", "value": 2}') == speed
    explorer = Ask(3, ParameterChange("explorer", "frontier"))
    assert parse('{"id": 3, "set": "explorer", "value": "frontier"}') == explorer
    position = Ask(4, PlaybackChange("position", 1.5))
    assert parse('{"id": 4, "playback": "position", "value": 1.5}') == position


@pytest.mark.parametrize(
    "message",
    [
        "pause", "[]", {}, {"id": "1", "request": "pause"}, {"id": True, "request": "pause"},
        {"id": 1, "request": "explode"}, {"id": 1, "request": ["pause"]}, {"id": 1, "set": 5},
        {"id": 1, "set": "plan_delay", "value": 1.0}, {"id": 1, "set": "top_speed"},
        {"id": 1, "set": "top_speed", "value": "2"}, {"id": 1, "set": "top_speed", "value": True},
        '{"id": 1, "set": "top_speed", "value": NaN}', {"id": 1, "set": "explorer", "value": "x"},
        {"id": 1, "set": "explorer", "value": ["tour"]},
    ],
)  # fmt: skip
def test_anything_else_is_refused(message):
    with pytest.raises(ProtocolError):
        parse(message if isinstance(message, str) else json.dumps(message))


def test_what_may_be_set_are_the_explorer_the_way_home_and_the_top_speed():
    assert set(SETTABLE) == {"explorer", "way_home", "top_speed"}
