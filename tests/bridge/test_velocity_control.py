"""The velocity loop around the simulator's vehicle, on flat ground: reached, held, stopped."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import pytest

from rover_bridge.velocity_control import VelocityControl
from rover_common.geometry import Pose, wrap_angle
from rover_common.sensor_types import Twist
from rover_common.types import Command
from rover_common.vehicle import ROVER
from rover_simulator.vehicle.ground import ground_under
from rover_simulator.vehicle.vehicle import STEP, Controls, Vehicle

STEPS = 2  # of the physics in a frame: 25 frames a second


@dataclass
class Drive:
    """A vehicle under the loop's commands; speeds and yaw rates by frame."""

    slope: float = 0.0  # rise per metre to the east
    speeds: list[float] = field(default_factory=list)  # [m/s]
    rates: list[float] = field(default_factory=list)  # [rad/s]
    commands: list[Command] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.vehicle = Vehicle(Pose(100.0, 100.0, 0.0))
        self._control = VelocityControl()
        self._stamp = 1_000_000_000

    def go(self, seconds: float, linear: float = 0.0, angular: float = 0.0) -> Drive:
        for _ in range(round(seconds / (STEPS * STEP))):
            vehicle = self.vehicle
            command = self._control.command(
                self._stamp, vehicle.pose, vehicle.reported_speed, Twist(linear, angular)
            )
            before = vehicle.pose.yaw
            controls = Controls(command.steering_angle, command.throttle, command.brake)
            for _ in range(STEPS):
                vehicle.step(controls, ground_under(vehicle.pose, self._surface))
            self._stamp += round(STEPS * STEP * 1e9)
            self.speeds.append(vehicle.speed)
            self.rates.append(wrap_angle(vehicle.pose.yaw - before) / (STEPS * STEP))
            self.commands.append(command)
        return self

    def _surface(self, x: float, y: float) -> tuple[float, float, float]:
        rises = self.slope if x > 101.0 else 0.0
        return rises * (x - 101.0), rises, 0.0

    def last_second(self, values: list[float]) -> list[float]:
        return values[-round(1.0 / (STEPS * STEP)) :]


@pytest.mark.parametrize("linear", [0.1, 0.3, 1.0, 2.5, 4.5, -0.3, -1.0, -1.8])
@pytest.mark.parametrize("curvature", [0.0, 0.15, -0.15])
def test_a_velocity_is_reached_and_held(linear, curvature):
    if abs(linear) > 3.0 and curvature:
        curvature /= 3.0  # the wheels turn less at speed
    drive = Drive().go(12.0, linear, linear * curvature)
    assert drive.last_second(drive.speeds) == pytest.approx([linear] * 25, rel=0.03, abs=0.02)
    rates = [linear * curvature] * 25
    assert drive.last_second(drive.rates) == pytest.approx(rates, rel=0.01, abs=0.002)


def test_one_metre_and_three_tenths_of_a_radian_a_second_are_there_within_two_seconds():
    drive = Drive().go(3.0, 1.0, 0.3)
    assert drive.last_second(drive.speeds) == pytest.approx([1.0] * 25, rel=0.05)
    assert drive.last_second(drive.rates) == pytest.approx([0.3] * 25, rel=0.05)
    assert max(drive.speeds) < 1.15


@pytest.mark.parametrize("rate", [0.3, -0.3, 0.7, 0.05])
def test_without_a_speed_it_turns_in_place(rate):
    drive = Drive().go(2.0, 0.0, rate)
    assert drive.last_second(drive.rates) == pytest.approx([rate] * 25, rel=0.01)
    assert math.dist((drive.vehicle.pose.x, drive.vehicle.pose.y), (100.0, 100.0)) < 0.01


def test_a_faster_turn_is_made_as_fast_as_it_can():
    drive = Drive().go(1.0, 0.0, 3.0)
    assert drive.rates[-1] == pytest.approx(math.radians(45.0), rel=0.01)
    tight = Drive().go(4.0, 1.0, 2.0)
    assert tight.commands[-1].steering_angle == pytest.approx(ROVER.max_steering)
    assert tight.speeds[-1] == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("linear", [1.0, -1.0])
def test_it_stands_half_a_second_after_it_is_to_stop(linear):
    drive = Drive().go(4.0, linear, 0.2).go(0.5)
    assert abs(drive.speeds[-1]) < ROVER.least_reported_speed
    assert drive.commands[-1].brake > 0.0


def test_a_turn_in_place_begins_when_it_stands():
    drive = Drive().go(4.0, 2.0).go(2.0, 0.0, 0.5)
    assert drive.rates[-1] == pytest.approx(0.5, rel=0.01)
    moving = [abs(r) for r, v in zip(drive.rates, drive.speeds, strict=True) if abs(v) > 0.4]
    assert max(moving) < 0.05


def test_it_turns_around_its_direction_by_the_brake():
    drive = Drive().go(4.0, 2.0).go(4.0, -1.0)
    assert drive.speeds[-1] == pytest.approx(-1.0, rel=0.03)
    assert all(
        command.throttle >= 0.0 or speed < 0.15
        for command, speed in zip(drive.commands, [0.0, *drive.speeds], strict=False)
    )


def test_a_slower_velocity_is_braked_to():
    drive = Drive().go(6.0, 3.0).go(2.0, 1.0)
    assert drive.last_second(drive.speeds) == pytest.approx([1.0] * 25, rel=0.16)
    assert drive.go(6.0, 1.0).speeds[-1] == pytest.approx(1.0, rel=0.05)


def test_a_slow_curve_that_is_to_become_slower_is_no_turn_in_place():
    drive = Drive().go(4.0, 0.28, 0.05).go(1.0, 0.2, 0.04)
    assert min(drive.speeds[-25:]) > 0.15


def test_it_holds_its_speed_on_a_slope():
    drive = Drive(slope=0.02).go(15.0, 1.0)
    assert drive.last_second(drive.speeds) == pytest.approx([1.0] * 25, rel=0.05)


def test_two_telemetries_of_one_frame_are_no_division_by_nothing():
    control, pose = VelocityControl(), Pose(100.0, 100.0, 0.0)
    for stamp in (1_000_000_000, 1_000_000_001, 1_040_000_001):
        command = control.command(stamp, pose, 0.0, Twist(1.0, 0.1))
    assert math.isfinite(command.throttle)
    assert math.isfinite(command.steering_angle)


def test_what_was_missed_before_a_gap_does_not_count():
    def first_command(stamps: list[int]) -> Command:
        control, pose = VelocityControl(), Pose(100.0, 100.0, 0.0)
        return [control.command(stamp, pose, 0.9, Twist(1.0)) for stamp in stamps][-1]

    second = 1_000_000_000
    held = [round(k * 0.04 * second) for k in range(1, 100)]
    fresh = first_command([second])
    assert first_command(held).throttle > fresh.throttle  # it stood in something's way
    assert first_command([*held, held[-1] + second]) == fresh
