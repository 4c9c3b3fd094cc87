"""The vehicle against what was measured of the original: each row of a table is one measurement."""

import math

import pytest

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_simulator.vehicle.ground import FLAT
from rover_simulator.vehicle.vehicle import STEP, Controls, Vehicle


def driven(controls: Controls, seconds: float, speed: float = 0.0) -> Vehicle:
    vehicle = Vehicle(Pose(100, 100, 0))
    vehicle.roll_on(speed, controls)
    for _ in range(round(seconds / STEP)):
        vehicle.step(controls, FLAT)
    return vehicle


@pytest.mark.parametrize(
    ("throttle", "speed", "acceleration"),
    [
        (1.0, 0.5, 0.84),
        (1.0, 2.0, 0.75),
        (1.0, 3.0, 0.69),
        (1.0, 4.5, 0.60),
        (0.2, 0.0, 0.170),
        (0.0, 2.25, -0.124),
        (0.0, 4.75, -0.274),
    ],
)
def test_acceleration(throttle, speed, acceleration):
    """[m/s^2] straight ahead, at a speed [m/s]."""
    after = driven(Controls(throttle=throttle), STEP, speed)
    assert (after.speed - speed) / STEP == pytest.approx(acceleration, abs=0.02)


@pytest.mark.parametrize(
    ("seconds", "speed"), [(1, 0.17), (2, 0.32), (5, 0.74), (10, 1.30), (20, 2.03), (120, 2.97)]
)
def test_speed_after_seconds_of_a_fifth_of_the_throttle(seconds, speed):
    assert driven(Controls(throttle=0.2), seconds).speed == pytest.approx(speed, abs=0.03)


@pytest.mark.parametrize(
    ("speed", "seconds", "metres"),
    # The keys ramp the brake in 0.33 s. The original brakes harder than its median just before it
    # stands, which the model's constant deceleration leaves out.
    [(3.2, 1.305, 2.05), (2.0, 0.87, 0.845)],
)
def test_full_brake_stops_in_time_and_distance(speed, seconds, metres):
    vehicle = Vehicle(Pose(0, 0, 0))
    vehicle.roll_on(speed, Controls())
    taken = 0.0
    while vehicle.speed > 0 and taken < 10:
        vehicle.step(Controls(brake=min(1.0, taken / 0.33)), FLAT)
        taken += STEP
    assert taken == pytest.approx(seconds, rel=0.15)
    assert vehicle.pose.x == pytest.approx(metres, rel=0.25)


@pytest.mark.parametrize(
    ("brake", "speed", "seconds", "metres"),
    [(2, 2.0, 0.48, 0.33), (5, 2.0, 0.3, 0.25), (10, 2.0, 0.3, 0.25), (10, 3.0, 0.5, 0.6)],
)
def test_stronger_brake_stops_as_derived(brake, speed, seconds, metres):
    vehicle = Vehicle(Pose(0, 0, 0))
    vehicle.roll_on(speed, Controls())
    taken = 0.0
    while vehicle.speed > 0 and taken < 10:
        vehicle.step(Controls(brake=brake), FLAT)
        taken += STEP
    assert taken == pytest.approx(seconds, abs=0.1)
    assert vehicle.pose.x == pytest.approx(metres, abs=0.16)


@pytest.mark.parametrize(
    ("throttle", "speed", "rate_deg"),
    [
        (0, 1.0, 17),
        (0, 1.5, 24),
        (0, 2.0, 29),
        (0, 2.5, 33),
        (0, 3.1, 35),
        (1, 3.75, 37),
        (1, 5, 33),
    ],
)
def test_yaw_rate_at_full_steering(throttle, speed, rate_deg):
    vehicle = driven(Controls(steering=ROVER.max_steering, throttle=throttle), STEP, speed)
    assert math.degrees(vehicle.pose.yaw) / STEP == pytest.approx(rate_deg, rel=0.06)


@pytest.mark.parametrize(("speed", "drag"), [(1.75, 0.03), (2.75, 0.06), (3.75, 0.13)])
def test_drag_in_a_turn(speed, drag):
    """[m/s^2] at full steering, more than straight ahead."""
    turning = driven(Controls(steering=ROVER.max_steering), STEP, speed).speed
    straight = driven(Controls(), STEP, speed).speed
    assert (straight - turning) / STEP == pytest.approx(drag, abs=0.04)


@pytest.mark.parametrize(("speed", "angle"), [(0.35, 6.4), (1.75, 4.0), (3.7, 0.0), (5.0, -1.4)])
def test_course_beside_the_yaw(speed, angle):
    """[deg] at full steering: inside of the yaw at low speed, outside of it at high."""
    vehicle = driven(Controls(steering=ROVER.max_steering, throttle=speed == 5.0), STEP, speed)
    course = math.atan2(vehicle.pose.y - 100, vehicle.pose.x - 100)
    assert math.degrees(course - vehicle.pose.yaw) == pytest.approx(angle, abs=1.0)


def test_the_yaw_rate_follows_the_wheels_late_at_high_speed_only():
    def share_after_a_step(speed: float) -> float:
        vehicle = Vehicle(Pose(0, 0, 0))
        vehicle.roll_on(speed, Controls())
        vehicle.step(Controls(steering=0.1), FLAT)
        first = vehicle.pose.yaw
        for _ in range(50):
            before = vehicle.pose.yaw
            vehicle.step(Controls(steering=0.1), FLAT)
        return first / (vehicle.pose.yaw - before)

    assert share_after_a_step(5.0) < 0.5
    assert share_after_a_step(0.5) > 0.8


@pytest.mark.parametrize("steering_deg", [-15.0, -4.0, 2.0, 15.0])
def test_in_place_it_turns_three_times_the_steering(steering_deg):
    turned = driven(Controls(steering=math.radians(steering_deg)), 1.0)
    assert math.degrees(turned.pose.yaw) == pytest.approx(3.0 * steering_deg, rel=0.01)
    assert math.hypot(turned.pose.x - 100, turned.pose.y - 100) < 0.002


@pytest.mark.parametrize(("speed", "turns"), [(0.30, True), (0.33, False)])
def test_in_place_only_below_a_third_of_a_metre_per_second(speed, turns):
    turned = driven(Controls(steering=ROVER.max_steering), 0.2, speed)
    assert (math.degrees(turned.pose.yaw) > 8.0) == turns
