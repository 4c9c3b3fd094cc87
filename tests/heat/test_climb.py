"""The climb, on a ramp of three slopes that a kinematic robot drives over."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from warm_room import Room, box

from rover_common.burger import BURGER
from rover_common.geometry import Pose
from rover_common.sensor_types import Twist
from rover_heat.config import HeatConfig
from rover_heat.ramp.climb import Climb, ClimbInput, Progress
from rover_heat.tilt import Lean

CONFIG = HeatConfig()
PERIOD = 0.05  # [s]
FOOT, WIDTH = 1.53, 1.02  # [m] where the ramp begins, and the strip that it lies in
STRIP = Room(box(WIDTH, 3.28))
PROFILE_X, PROFILE_Z = (0.0, 0.5, 0.75, 1.25), (0.0, 0.06, 0.06, 0.0)
BELOW = Pose(WIDTH / 2, FOOT - 0.5, math.pi / 2)


@dataclass
class Climber:
    """Pitch by the heights of axle and caster; the mean of 0.3 s as the monitor makes it."""

    pose: Pose = BELOW
    ramp: bool = True
    grip: float = 1.0  # share of the wheels' path that the robot makes

    def __post_init__(self) -> None:
        self.time, self.twist = 0.0, Twist()
        self.pitches = [0.0] * 6

    def height(self, back: float) -> float:
        along = self.pose.y + back * math.sin(self.pose.yaw) - FOOT
        return float(np.interp(along, PROFILE_X, PROFILE_Z)) if self.ramp else 0.0

    def step(self, twist: Twist) -> None:
        self.time += PERIOD
        self.twist = twist
        yaw = self.pose.yaw + PERIOD * twist.angular
        way = PERIOD * twist.linear * self.grip
        x, y = self.pose.x + way * math.cos(yaw), self.pose.y + way * math.sin(yaw)
        self.pose = Pose(x, y, yaw)
        rise = self.height(0.0) - self.height(BURGER.caster_x)
        self.pitches = [*self.pitches[1:], -math.atan2(rise, -BURGER.caster_x)]

    def seen(self) -> ClimbInput:
        lean = Lean(0.0, float(np.mean(self.pitches)))
        scan = STRIP.scan(self.pose, 0)
        return ClimbInput(self.time, self.pose, self.twist.linear, lean, scan)

    @property
    def beyond(self) -> float:
        """[m] of the axle beyond the foot."""
        return self.pose.y - FOOT


def climbed(climber: Climber, config: HeatConfig = CONFIG, seconds: float = 20.0) -> Climb:
    climb = Climb(math.pi / 2, config.ramp_speed, config)
    while climber.time < seconds and climb.progress in (Progress.CLIMBING, Progress.BACKING):
        climb.update(climber.seen())
        climber.step(climb.twist)
    return climb


@pytest.mark.parametrize("aside", [-0.08, 0.0, 0.08])
@pytest.mark.parametrize("turned", [-0.14, 0.0, 0.14])
@pytest.mark.parametrize("speed", [0.10, 0.15, 0.20])
def test_it_stops_on_the_flat_part_in_the_middle(aside, turned, speed):
    climber = Climber(Pose(WIDTH / 2 + aside, FOOT - 0.5, math.pi / 2 + turned))
    climb = climbed(climber, replace(CONFIG, ramp_speed=speed))
    assert climb.progress is Progress.ON_TOP
    assert climb.twist == Twist()
    assert 0.5 - BURGER.caster_x <= climber.beyond <= 0.75
    assert abs(climber.pose.x - WIDTH / 2) < 0.08


def test_it_turns_no_faster_than_it_may():
    climb = Climb(math.pi / 2, 0.15, CONFIG)
    climb.update(Climber(Pose(0.5, 1.0, 0.3)).seen())
    assert climb.twist.angular == pytest.approx(0.6)


def test_beyond_the_flat_part_it_backs_onto_it():
    climber = Climber()
    climb = Climb(math.pi / 2, 0.22, CONFIG)
    while climber.beyond < 0.9:  # something pushes it on
        climb.update(climber.seen())
        climber.step(Twist(0.6))
    assert climb.progress is Progress.BACKING
    while climb.progress is Progress.BACKING:
        climb.update(climber.seen())
        climber.step(climb.twist)
    assert climb.progress is Progress.ON_TOP
    assert 0.5 - BURGER.caster_x <= climber.beyond <= 0.75


def test_where_there_is_no_ramp_it_fails_before_the_wall():
    climber = Climber(ramp=False)
    assert climbed(climber).progress is Progress.FAILED
    assert 3.28 - climber.pose.y > 0.20
    near = Climber(Pose(WIDTH / 2, 2.9, math.pi / 2), ramp=False)
    assert climbed(near).progress is Progress.FAILED
    assert 3.28 - near.pose.y > 0.20


def test_wheels_that_slip_or_stand_are_a_failure():
    assert climbed(Climber(grip=0.0)).progress is Progress.FAILED
    climb = Climb(math.pi / 2, 0.15, CONFIG)
    seen = replace(Climber().seen(), speed=0.0)
    for step in range(25):
        climb.update(replace(seen, time=step * PERIOD))
    assert climb.progress is Progress.FAILED


def test_over_the_ramp_to_the_wall_when_asked():
    climber = Climber()
    climb = climbed(climber, replace(CONFIG, ramp_end="wall"), seconds=40.0)
    assert climb.progress is Progress.ON_TOP
    assert 3.28 - climber.pose.y == pytest.approx(0.2, abs=0.06)


def test_without_a_scan_it_holds_the_heading():
    climb = Climb(math.pi / 2, 0.15, CONFIG)
    climb.update(replace(Climber().seen(), scan=None))
    assert climb.twist == Twist(0.15, 0.0)
