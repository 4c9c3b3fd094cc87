"""The embedded simulator: the measured vehicle, the arm, the wire's rules, repeatable runs."""

import math

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_simulator.simulation import Simulation
from rover_simulator.vehicle.arm import Arm
from rover_simulator.vehicle.ground import FLAT, Ground
from rover_simulator.vehicle.vehicle import STEP, Controls, Vehicle
from rover_simulator.world.world import World

HALL = np.zeros((200, 200), bool)
HALL[80:121, 80:121] = True


def driven(
    controls: Controls, seconds: float, speed: float = 0.0, ground: Ground = FLAT
) -> Vehicle:
    vehicle = Vehicle(Pose(100, 100, 0))
    vehicle.speed = speed
    for _ in range(round(seconds / STEP)):
        vehicle.step(controls, ground)
    return vehicle


def test_throttle_accelerates_as_measured():
    assert driven(Controls(throttle=0.2), 1).speed == pytest.approx(0.17, abs=0.02)
    assert driven(Controls(throttle=0.2), 5).speed == pytest.approx(0.74, abs=0.03)
    assert driven(Controls(throttle=0.2), 120).speed == pytest.approx(2.97, abs=0.05)
    assert driven(Controls(throttle=1), 30).speed == pytest.approx(5.0)
    assert driven(Controls(throttle=-1), 30).speed == pytest.approx(-2.0)


def test_it_hardly_slows_without_the_brake_and_stops_with_it():
    assert driven(Controls(), 17.4, speed=2.0).speed == pytest.approx(2.0 / math.e, abs=0.02)
    assert driven(Controls(brake=1), 1.0, speed=2.0).speed == 0.0
    assert driven(Controls(brake=0.25), 1.0, speed=2.0).speed == pytest.approx(1.2, abs=0.15)


@pytest.mark.parametrize(("speed", "rate_deg"), [(1.0, 17), (2.0, 29), (3.0, 36)])
def test_turns_as_measured(speed, rate_deg):
    vehicle = Vehicle(Pose(0, 0, 0))
    controls = Controls(steering=ROVER.max_steering)
    vehicle.roll_on(speed, controls)
    vehicle.step(controls, FLAT)
    assert math.degrees(vehicle.pose.yaw / STEP) == pytest.approx(rate_deg, rel=0.1)


def test_in_place_turn_and_its_condition():
    turned = driven(Controls(steering=ROVER.max_steering), 1.0)
    assert math.degrees(turned.pose.yaw) == pytest.approx(45.0, abs=0.1)
    assert (turned.pose.x, turned.pose.y) == (100, 100)
    held = driven(Controls(steering=ROVER.max_steering, brake=0.1), 1.0)
    assert held.pose.yaw == 0.0
    rolling = driven(Controls(steering=ROVER.max_steering), 0.1, speed=1.0)
    assert rolling.pose.x > 100.05


def test_throttle_lowers_the_nose_and_left_turns_lean_left():
    vehicle = driven(Controls(throttle=1), 1.0)
    assert vehicle.pose.pitch > math.radians(0.5)
    turning = driven(Controls(throttle=0.5, steering=ROVER.max_steering), 3.0, speed=2.0)
    assert turning.pose.roll < -math.radians(0.5)


def test_a_slope_pushes_the_rover_back():
    vehicle = driven(Controls(), 1.5, speed=1.0, ground=Ground(pitch=-math.atan(0.3), ahead=0.3))
    assert vehicle.speed < 0
    assert vehicle.pose.pitch < 0


def test_the_arm_takes_ten_seconds_and_one_sample():
    pose = Pose(100, 100, 0)
    arm = Arm([(100.9, 100.1), (150.0, 150.0)])
    assert arm.near_sample(pose)
    arm.start(pose)
    for _ in range(249):
        arm.advance(0.04)
        assert arm.picking_up
    arm.advance(0.04)
    assert not arm.picking_up
    assert arm.samples == [(150.0, 150.0)]
    assert not arm.near_sample(pose)


def test_a_pickup_of_nothing_freezes_for_good():
    arm = Arm([(150.0, 150.0)])
    arm.start(Pose(100, 100, 0))
    arm.advance(1000.0)
    assert arm.picking_up
    assert not arm.near_sample(Pose(149.2, 150, 0))


@pytest.fixture(scope="module")
def world() -> World:
    return World("hall", HALL, np.array([[104.0, 100.0]]), Pose(100, 100, 0))


def few_rows(_: Pose) -> int:
    """Where no image is needed."""
    return 152


def command(throttle: str = "0.5", steering: str = "0", brake: str = "0") -> dict[str, str]:
    return {"steering_angle": steering, "throttle": throttle, "brake": brake}


def test_the_same_commands_give_the_same_telemetry(world):
    def run() -> list[dict[str, str]]:
        simulation = Simulation(world, 0, 2)
        telemetries = []
        for index in range(25):
            simulation.handle("data", command(steering=str(index % 7 - 3)))
            simulation.advance()
            telemetries.append(simulation.telemetry())
        return telemetries

    assert run() == run()


@pytest.mark.parametrize(
    "bad",
    [
        {"steering_angle": "0"},
        {"steering_angle": 0, "throttle": "0"},
        {"steering_angle": "0", "throttle": "NaN"},
        {"steering_angle": "0", "throttle": "fast"},
        {"steering_angle": "0", "throttle": "0", "brake": 1},
    ],
)
def test_a_command_that_unity_cannot_parse_loses_its_answer(world, bad):
    simulation = Simulation(world, 0, 2)
    assert not simulation.handle("data", bad)
    assert simulation.handle("data", command())


def test_fields_before_an_error_are_applied_and_steering_is_clamped(world):
    simulation = Simulation(world, 0, 2)
    simulation.handle("data", {"steering_angle": "99", "throttle": "0.5", "brake": "x"})
    telemetry = simulation.telemetry()
    assert (telemetry["steering_angle"], telemetry["throttle"]) == ("15.0000", "0.5000")


def test_commands_stay_latched_and_the_image_is_one_frame_older(world):
    simulation = Simulation(world, 0, 2)
    simulation.handle("data", command("1"))
    images = []
    for _ in range(30):
        simulation.advance()
        images.append(simulation.telemetry()["image"])
    assert float(simulation.telemetry()["speed"]) > 0.5
    standing = Simulation(world, 0, 2)
    standing.advance()
    assert images[0] == standing.telemetry()["image"]
    assert images[-1] != images[0]


def test_unknown_events_are_ignored_and_manual_is_answered(world):
    simulation = Simulation(world, 0, 2)
    assert not simulation.handle("get_samples", {})
    assert simulation.handle("manual", {})


def test_a_wall_is_a_contact_and_holds_the_rover(world):
    simulation = Simulation(world, 0, 2)
    simulation.crop_images(few_rows)
    simulation.handle("data", command("1"))
    for _ in range(250):
        simulation.advance()
    assert simulation.contacts >= 1
    assert simulation.pose.x < 125


def test_a_rock_in_the_open_stops_the_rover():
    ground = HALL.copy()
    ground[100, 104] = False
    world = World("rock", ground, np.empty((0, 2)), Pose(100.5, 100.5, 0.0))
    (boulder,) = world.boulders
    simulation = Simulation(world, 0, 2)
    simulation.crop_images(few_rows)
    simulation.handle("data", command(throttle="0.5"))
    for _ in range(150):
        simulation.advance()
    assert simulation.pose.x == pytest.approx(boulder.x - boulder.radius - 0.535, abs=0.05)
    assert simulation.contacts == 1
    simulation.handle("data", command(throttle="-0.5"))
    for _ in range(50):
        simulation.advance()
    assert simulation.pose.x < 102.8
