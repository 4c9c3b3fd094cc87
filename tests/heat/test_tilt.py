"""When a tilt is one, whatever the stance, the rate and the kind of the inertial unit."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from imus import imu

from rover_heat.config import HeatConfig
from rover_heat.tilt import TiltMonitor

CONFIG = HeatConfig()
SECOND = 1_000_000_000
STANCE = {"roll": 0.01, "pitch": -0.0105}  # [rad] of a burger: its caster is lower than its wheels
RAMP = math.atan2(0.06, 0.50)  # [rad] of the challenge


class Tilted:
    """A monitor that is fed at a rate, from 2 s of rest on."""

    def __init__(self, config: HeatConfig = CONFIG, rate: int = 100, orientation="measured"):
        self.monitor = TiltMonitor(config)
        self.rate, self.orientation = rate, orientation
        self.stamp = SECOND
        self.feed(2.0)
        self.monitor.set_level(self.stamp)

    def feed(self, seconds: float, roll: float = 0.0, pitch: float = 0.0, **rates) -> float:
        """[s] until it is a tilt, inf where it never is; angles from the stance."""
        fired = math.inf
        for step in range(round(seconds * self.rate)):
            self.stamp += SECOND // self.rate
            sample = imu(
                self.stamp, STANCE["roll"] + roll, STANCE["pitch"] + pitch,
                orientation=self.orientation, **rates,
            )  # fmt: skip
            self.monitor.update([sample])
            if self.monitor.share > 1.0 and math.isinf(fired):
                fired = (step + 1) / self.rate
        return fired


@pytest.mark.parametrize("rate", [20, 100, 200])
@pytest.mark.parametrize("way", [{"pitch": -RAMP}, {"pitch": RAMP}, {"roll": RAMP}])
def test_the_ramp_of_the_challenge_is_a_tilt_within_the_mean(rate, way):
    tilted = Tilted(rate=rate)
    assert tilted.feed(1.0, **way) <= 0.2
    tilted.feed(0.4)
    assert tilted.monitor.share < 0.1


def test_a_slope_that_pitch_and_roll_share_is_a_tilt_as_soon_as_one_of_either():
    slope = 1.1 * CONFIG.ramp_rise
    shared = {"pitch": -slope * math.cos(0.8), "roll": slope * math.sin(0.8)}
    assert Tilted().feed(1.0, **shared) == Tilted().feed(1.0, pitch=-slope) < 1.0


def test_it_is_one_every_time_and_over_when_the_robot_is_level_again():
    tilted = Tilted()
    for _ in range(5):
        assert tilted.feed(1.0, pitch=-RAMP) < 0.3
        tilted.feed(1.0)
        assert tilted.monitor.share < 0.1


def test_driving_on_flat_ground_is_none():
    tilted = Tilted()
    rng = np.random.default_rng(3)
    for _ in range(3000):
        assert math.isinf(
            tilted.feed(0.01, pitch=rng.normal(0.0, 0.016), roll=rng.normal(0, 0.016))
        )


def test_a_single_value_beyond_the_absolute_threshold_is_one_at_once():
    tilted = Tilted()
    assert tilted.feed(0.01, pitch=-0.17) == pytest.approx(0.01)
    assert math.isinf(Tilted().feed(0.01, pitch=-0.15))


def test_the_absolute_threshold_alone_never_sees_the_ramp():
    tilted = Tilted(replace(CONFIG, ramp_rise=0.5))
    assert math.isinf(tilted.feed(3.0, pitch=-RAMP))


def test_the_rule_of_the_running_mean_stays_armed_beside_the_others():
    """Each rule has a state of its own: none of them switches another off."""
    config = replace(CONFIG, imu_threshold=5.0, ramp_rise=0.5)
    tilted = Tilted(config)
    assert tilted.feed(1.0, pitch=-RAMP) < 0.1
    assert math.isinf(Tilted(replace(config, imu_threshold=0.0)).feed(1.0, pitch=-RAMP))
    assert Tilted(replace(config, imu_abs_threshold=0.1)).feed(1.0, pitch=-RAMP) < 0.1


@pytest.mark.parametrize("orientation", ["none", "zero"])
def test_without_an_orientation_accelerometer_and_gyro_tell(orientation):
    tilted = Tilted(orientation=orientation)
    rise = 0.3
    for step in range(30):
        tilted.feed(0.01, pitch=-RAMP * step / 30, rates=(0.0, -RAMP / rise, 0.0))
    assert tilted.feed(1.0, pitch=-RAMP) < 0.3


def test_without_a_level_there_is_no_tilt():
    monitor = TiltMonitor(CONFIG)
    monitor.update([imu(SECOND, pitch=0.5)])
    assert monitor.share == 0.0


def test_a_sample_that_is_not_a_number_says_nothing():
    tilted = Tilted()
    tilted.monitor.update([imu(tilted.stamp + 1, rates=(math.nan, 0.0, 0.0))])
    assert tilted.monitor.share < 0.1
    assert tilted.feed(1.0, pitch=-RAMP) < 0.3


def test_a_thermal_frame_is_fit_on_level_ground_without_a_turn():
    tilted = Tilted()
    tilted.feed(1.0)
    assert tilted.monitor.fit(tilted.stamp)
    tilted.feed(0.5, rates=(0.0, 0.0, 0.31))
    assert not tilted.monitor.fit(tilted.stamp)
    tilted.feed(0.5)
    assert tilted.monitor.fit(tilted.stamp)
    tilted.feed(0.5, pitch=0.055)
    assert not tilted.monitor.fit(tilted.stamp)


def test_the_bias_of_the_gyro_is_no_turn():
    monitor = TiltMonitor(CONFIG)
    stamps = range(SECOND, 3 * SECOND, SECOND // 100)
    monitor.update([imu(stamp, rates=(0.0, 0.0, 0.05)) for stamp in stamps])
    monitor.set_level(stamps[-1])
    assert monitor.turn_rate(stamps[-1]) == pytest.approx(0.0, abs=1e-9)
