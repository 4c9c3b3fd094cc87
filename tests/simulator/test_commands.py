"""Commands, valid and invalid: what is applied, and whether a telemetry answers them."""

from __future__ import annotations

import base64
import math

import cv2
import numpy as np
import pytest
from simulator_controls import BEFORE, FRAME, GOOD, HELD, held, simulation_of

from rover_simulator.simulation import Simulation


@pytest.fixture(scope="module")
def shared() -> Simulation:
    """One for tests that set its controls first, because making one takes seconds."""
    return simulation_of()


def without(key: str) -> dict[str, str]:
    return {name: value for name, value in GOOD.items() if name != key}


@pytest.mark.parametrize(
    ("changed", "applied"),
    [
        (without("steering_angle"), 0),
        (without("throttle"), 1),
        ({}, 0),
        (GOOD | {"steering_angle": -3}, 0),
        (GOOD | {"steering_angle": "NaN"}, 0),
        (GOOD | {"steering_angle": None}, 0),
        (GOOD | {"throttle": 0.1}, 1),
        (GOOD | {"throttle": "NaN"}, 1),
        (GOOD | {"throttle": "fast"}, 1),
        (GOOD | {"throttle": ""}, 1),
        (GOOD | {"throttle": "Infinity"}, 1),
        (GOOD | {"throttle": "1e39"}, 1),  # beyond 32 bits
        (GOOD | {"throttle": "-1e999"}, 1),
        (GOOD | {"throttle": "1_0"}, 1),
        (GOOD | {"throttle": "\u0661"}, 1),  # a digit, but not of ours
        (GOOD | {"throttle": r"\u0030"}, 1),  # escapes are not decoded
        (GOOD | {"throttle": True}, 1),
        (GOOD | {"throttle": ["0.1"]}, 1),
        (GOOD | {"brake": 0}, 2),
        (GOOD | {"brake": "NaN"}, 2),
        (GOOD | {"brake": "x"}, 2),
        (GOOD | {"inset_image1": "!"}, 3),
        (GOOD | {"inset_image1": "AAA"}, 3),
        (GOOD | {"inset_image2": 0}, 3),
        (GOOD | {"inset_image1": "", "inset_image3": "AA=A"}, 3),
    ],
    ids=str,
)
def test_a_command_that_cannot_be_parsed_loses_its_answer(shared, changed, applied):
    assert shared.handle("data", BEFORE)
    assert not shared.handle("data", changed)
    assert held(shared) == HELD[applied]
    time = shared.time
    assert shared.handle("data", GOOD)  # and the simulator goes on
    shared.advance()
    assert shared.time > time
    assert held(shared) == HELD[3]


@pytest.mark.parametrize(
    ("command", "expected"),
    [
        (GOOD, HELD[3]),
        (without("brake"), ("-3.0000", "0.1000", "0.0000")),
        (GOOD | {"steering_angle": "1e30"}, ("15.0000", "0.1000", "0.2000")),
        (GOOD | {"steering_angle": "-15.1"}, ("-15.0000", "0.1000", "0.2000")),
        (GOOD | {"throttle": "-7", "brake": "10"}, ("-3.0000", "-7.0000", "10.0000")),
        (GOOD | {"brake": "1234.5"}, ("-3.0000", "0.1000", "1,234.5000")),
        (GOOD | {"throttle": " +1.e-1 ", "brake": ".2"}, HELD[3]),
        (GOOD | {"inset_image1": "", "inset_image2": "AAA=", "inset_image3": "AA\n=="}, HELD[3]),
        (GOOD | {"unknown": 5}, HELD[3]),
    ],
    ids=str,
)
def test_a_command_that_can_be_parsed_is_applied_whole(shared, command, expected):
    assert shared.handle("data", BEFORE)
    assert shared.handle("data", command)
    assert held(shared) == expected


def test_huge_controls_do_no_harm():
    simulation = simulation_of()
    huge = {"steering_angle": "3e38", "throttle": "3e38", "brake": "0"}
    assert simulation.handle("data", huge)
    for _ in range(25):
        simulation.advance()
    telemetry = simulation.telemetry()
    assert 0 < float(telemetry["speed"]) <= 5.0
    assert all(math.isfinite(float(part)) for part in telemetry["position"].split(";"))


@pytest.mark.parametrize("name", ["get_samples", "Data", "open", "telemetry", ""])
def test_unknown_events_change_nothing(shared, name):
    shared.handle("data", BEFORE)
    assert not shared.handle(name, GOOD)
    assert held(shared) == HELD[0]


def test_a_pickup_with_nothing_near_freezes_for_ever():
    simulation = simulation_of((104.0, 100.0))
    simulation.handle("data", {"steering_angle": "0", "throttle": "1"})
    for _ in range(10):
        simulation.advance()
    assert simulation.handle("pickup", {})
    stopped = simulation.pose
    for event in ("data", "manual", "pickup"):
        assert simulation.handle(event, GOOD)
    assert simulation.handle("fixed_turn", {"angle": "90"})
    for _ in range(300):
        simulation.advance()
    telemetry = simulation.telemetry()
    assert (telemetry["picking_up"], telemetry["near_sample"]) == ("1", "0")
    assert (telemetry["speed"], telemetry["sample_count"]) == ("0.0000", "1")
    assert held(simulation) == ("0.0000", "1.0000", "0.0000")
    assert simulation.pose == stopped


def test_a_pickup_frame_by_frame():
    """Two samples in reach, so that the second one must not show before the end."""
    simulation = simulation_of((100.9, 100.1), (150.0, 150.0), (100.9, 100.2))
    before = {"steering_angle": "0", "throttle": "0", "brake": "1"}
    simulation.handle("data", before)
    simulation.advance()
    assert simulation.telemetry()["near_sample"] == "1"
    assert simulation.handle("pickup", {})
    frames = []
    for _ in range(251):
        assert simulation.handle("data", GOOD)
        assert simulation.handle("pickup", {})
        simulation.advance()
        frames.append(simulation.telemetry())
    running = [frame["picking_up"] for frame in frames]
    # The answer to the commands of the last frame: a second sample is taken at once.
    assert running == ["1"] * 249 + ["0", "1"]
    assert [frame["sample_count"] for frame in frames] == ["3"] * 248 + ["2"] * 3
    assert [frame["near_sample"] for frame in frames] == ["1"] * 248 + ["0", "1", "1"]
    assert {frame["speed"] for frame in frames} == {"0.0000"}
    assert {frame["brake"] for frame in frames[:250]} == {"1.0000"}
    assert len({frame["position"] + frame["yaw"] for frame in frames}) == 1
    listed = [frame["samples_x"] + " " + frame["samples_y"] for frame in frames]
    still = int(2.5 / FRAME)  # frames until the gripper has the sample
    assert set(listed[:still]) == {"100.90;150.00;100.90 100.10;150.00;100.20"}
    assert listed[still + 5] != listed[0]
    assert len(set(listed[still : int(7.0 / FRAME)])) > 60  # of 113 frames, at two digits
    assert all(";150.00;100.90 " in entry for entry in listed[:248])
    assert listed[247].startswith("100.06;")  # on the flatbed, 0.061 m ahead of the origin
    assert listed[248] == "150.00;100.90 150.00;100.20"


def yellow_pixels(simulation: Simulation) -> int:
    data = np.frombuffer(base64.b64decode(simulation.telemetry()["image"]), np.uint8)
    blue, _, red = cv2.split(cv2.imdecode(data, cv2.IMREAD_COLOR).astype(int))
    return int((red - blue > 60).sum())


def test_a_sample_that_is_lifted_disappears_from_the_image():
    simulation = simulation_of((101.2, 100.0), (104.0, 101.0))
    simulation.advance()
    both = yellow_pixels(simulation)
    assert both > 300
    simulation.handle("pickup", {})
    for _ in range(int(2.5 / FRAME)):
        simulation.advance()
    assert yellow_pixels(simulation) == both
    for _ in range(2):  # the image is one frame older
        simulation.advance()
    assert 5 < yellow_pixels(simulation) < both / 5
