"""The telemetry object: every value a string, in the simulator's order and formats."""

from __future__ import annotations

import math

import pytest
from telemetry import telemetry

from rover_common.geometry import Pose

KEYS = (
    "steering_angle", "throttle", "brake", "speed", "position", "pitch", "yaw", "roll",
    "near_sample", "picking_up", "sample_count", "samples_x", "samples_y", "image",
)  # fmt: skip


def test_keys_come_in_the_simulators_order_and_every_value_is_a_string():
    assert tuple(telemetry()) == KEYS
    assert tuple(telemetry(sim_time=1.0)) == (*KEYS, "sim_time")
    assert all(isinstance(value, str) for value in telemetry(sim_time=1.0).values())


def pose(**angles_deg: float) -> Pose:
    return Pose(0, 0, **{"yaw": 0.0} | {k: math.radians(v) for k, v in angles_deg.items()})


@pytest.mark.parametrize(
    ("key", "changes", "expected"),
    [
        ("position", {"pose": Pose(99.67, 85.589, 0)}, "99.6700;85.5890"),
        ("position", {"pose": Pose(-0.016, -0.00004, 0)}, "-0.0160;0.0000"),
        ("speed", {"speed": -0.00001}, "0.0000"),
        ("speed", {"speed": -0.0001}, "-0.0001"),
        ("steering_angle", {"steering_angle": math.radians(-7.5)}, "-7.5000"),
        ("throttle", {"throttle": -1234567.25}, "-1,234,567.2500"),
        ("brake", {"brake": 999.99999}, "1,000.0000"),
        ("yaw", {"pose": pose(yaw=56.8256)}, "56.8256"),
        ("yaw", {"pose": pose(yaw=-90)}, "270.0000"),
        ("yaw", {"pose": pose(yaw=-0.000001)}, "360.0000"),
        ("pitch", {"pose": pose(pitch=-1.25)}, "358.7500"),  # nose up
        ("roll", {"pose": pose(roll=-1.25)}, "1.2500"),  # right side up
        ("near_sample", {"near_sample": True}, "1"),
        ("picking_up", {"picking_up": False}, "0"),
        ("sample_count", {"sample_count": 6}, "6"),
        ("samples_x", {"samples": ((109.784, 1), (62.63, -0.001))}, "109.78;62.63"),
        ("samples_y", {"samples": ((109.784, 1), (62.63, -0.001))}, "1.00;0.00"),
        ("samples_x", {"samples": ()}, ""),
        ("sim_time", {"sim_time": 1234.04}, "1234.0400"),  # not the simulator's: no groups
        ("position", {"pose": Pose(99.67, 85.589, 0), "decimal": ","}, "99,6700;85,5890"),
        ("throttle", {"throttle": 1234.5, "decimal": ","}, "1.234,5000"),
        ("sim_time", {"sim_time": 1234.04, "decimal": ","}, "1234,0400"),
    ],
    ids=str,
)
def test_formats(key, changes, expected):
    assert telemetry(**changes)[key] == expected
