"""Fixed turns: their angle and time, and the commands that prevent them."""

from __future__ import annotations

import math

import pytest
from simulator_controls import BEFORE, FRAME, GOOD, HELD, held, simulation_of

from rover_simulator.simulation import Simulation


@pytest.fixture(scope="module")
def shared() -> Simulation:
    """One for tests that set its controls first, because making one takes seconds."""
    return simulation_of()


@pytest.mark.parametrize(
    ("event", "seconds"),
    [
        ({"angle": "90"}, 2.0),
        ({"angle": "90", "time": "0"}, 2.0),
        ({"angle": "-45", "time": "0.4"}, 0.4),
        ({"angle": "-9"}, 0.2),
    ],
    ids=str,
)
def test_a_fixed_turn_goes_clockwise_in_its_time(event, seconds):
    simulation = simulation_of()
    assert simulation.handle("fixed_turn", event)
    angle = -math.radians(float(event["angle"]))
    frames = round(seconds / FRAME)
    for index in range(frames + 3):
        assert simulation.handle("data", GOOD if index < frames else BEFORE | {"throttle": "0"})
        assert simulation.handle("fixed_turn", {"angle": "10"})
        if index < frames:
            assert held(simulation) == ("0.0000", "0.0000", "0.0000")
            assert simulation.telemetry()["speed"] == "0.0000"
        simulation.advance()
        share = min(1.0, (index + 1) / frames)
        assert simulation.pose.yaw == pytest.approx(share * angle, abs=1e-9)
    assert (simulation.pose.x, simulation.pose.y) == (100, 100)
    assert held(simulation) == ("5.0000", "0.0000", "0.2500")  # commands count again


def test_a_fixed_turn_ignores_a_pickup():
    simulation = simulation_of()
    simulation.handle("fixed_turn", {"angle": "90"})
    simulation.advance()
    assert simulation.handle("pickup", {})
    assert simulation.telemetry()["picking_up"] == "0"


@pytest.mark.parametrize(
    "command",
    [
        {"steering_angle": "5", "throttle": "0"},
        {"steering_angle": "0", "throttle": "0.1"},
        {"steering_angle": "0", "throttle": "0", "brake": "0.1"},
    ],
    ids=str,
)
def test_a_rover_that_is_told_something_else_makes_no_fixed_turn(shared, command):
    assert shared.handle("data", command)
    assert shared.handle("fixed_turn", {"angle": "90"})  # ignored, but answered
    assert shared.handle("data", GOOD)
    assert held(shared) == HELD[3]


def test_a_rolling_rover_makes_no_fixed_turn():
    simulation = simulation_of()
    simulation.handle("data", {"steering_angle": "0", "throttle": "1"})
    for _ in range(10):
        simulation.advance()
    simulation.handle("data", {"steering_angle": "0", "throttle": "0"})
    assert simulation.handle("fixed_turn", {"angle": "90"})
    simulation.advance()
    assert simulation.pose.yaw == 0.0
    assert float(simulation.telemetry()["speed"]) > 0


@pytest.mark.parametrize(
    "bad", [{}, {"angle": 90}, {"angle": "east"}, {"angle": "90", "time": 2}], ids=str
)
def test_a_fixed_turn_that_cannot_be_parsed_loses_its_answer(shared, bad):
    shared.handle("data", {"steering_angle": "0", "throttle": "0"})
    yaw = shared.pose.yaw
    assert not shared.handle("fixed_turn", bad)
    shared.advance()
    assert shared.handle("data", GOOD)
    assert held(shared) == HELD[3]
    assert shared.pose.yaw == pytest.approx(yaw, abs=0.2)
