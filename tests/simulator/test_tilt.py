"""The tilt of the body: within the suspension's stops, over the ground under its four wheels."""

import math

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_simulator.vehicle.ground import FLAT, ground_under
from rover_simulator.vehicle.tilt import Swing
from rover_simulator.vehicle.vehicle import STEP, Controls, Vehicle
from rover_simulator.world.terrain import COUNT, Terrain

HALL = np.zeros((200, 200), bool)
HALL[80:120, 80:120] = True
MANOEUVRES = {
    "hard turns": [Controls(side * ROVER.max_steering, throttle=1.0) for side in (1, -1, 1, -1)],
    "starts and stops": [Controls(throttle=1.0), Controls(brake=1.0)] * 2,
    "a locked brake": [Controls(throttle=1.0), Controls(brake=10.0)] * 2,
}


@pytest.fixture(scope="module")
def terrain() -> Terrain:
    """A hall whose walls have the median profile everywhere."""
    return Terrain.of(HALL, relief=np.ones((COUNT, COUNT)))


def floor_edge(terrain: Terrain) -> float:
    """Where [m] the hall's floor ends and its east wall begins, in its middle."""
    x = np.arange(119.0, 123.0, 0.001)
    return float(x[np.argmax(terrain.height_at(x, np.full_like(x, 100.0)) > 0.0)])


@pytest.mark.parametrize("manoeuvre", MANOEUVRES)
def test_on_the_floor_the_body_tilts_to_the_stops_and_never_beyond(manoeuvre):
    vehicle = Vehicle(Pose(100, 100, 0))
    tilts = []
    for controls in MANOEUVRES[manoeuvre]:
        for _ in range(150):
            vehicle.step(controls, FLAT)
            tilts.append((abs(vehicle.pose.pitch), abs(vehicle.pose.roll)))
    pitch, roll = np.max(tilts, axis=0)
    assert pitch <= ROVER.pitch_stop
    assert roll <= ROVER.roll_stop
    assert max(pitch / ROVER.pitch_stop, roll / ROVER.roll_stop) == 1.0


def test_the_stops_follow_from_the_travel_of_the_wheels():
    assert math.degrees(ROVER.pitch_stop) == pytest.approx(1.31, abs=0.005)
    assert math.degrees(ROVER.roll_stop) == pytest.approx(1.19, abs=0.005)


def test_at_the_stop_the_body_has_no_rate():
    swing = Swing(rate=1.0)
    while swing.angle < 0.02:
        swing = swing.step(0.0, 0.0, 0.02, STEP)
    assert swing == Swing(0.02, 0.0)


def test_ground_that_rises_lifts_the_body_with_its_stop():
    swing = Swing().step(0.3, 0.0, 0.02, STEP)
    assert swing == Swing(pytest.approx(0.28), 0.0)


@pytest.mark.parametrize(
    ("yaw_deg", "pitch_sign", "roll_sign"), [(0, -1, 0), (90, 0, -1), (180, 1, 0), (270, 0, 1)]
)
def test_a_plane_that_rises_to_the_east_tilts_the_body(yaw_deg, pitch_sign, roll_sign):
    """Uphill the nose is up, which is negative; with the hill to its right the left side is low."""
    yaw = math.radians(yaw_deg)
    ground = ground_under(Pose(3.0, 4.0, yaw), lambda x, y: (0.2 * x, 0.2, 0.0))
    assert ground.pitch == pytest.approx(pitch_sign * math.atan(0.2))
    assert ground.roll == pytest.approx(roll_sign * math.atan(0.2))
    assert ground.height == pytest.approx(0.6)
    assert ground.ahead == pytest.approx(0.2 * math.cos(yaw))
    assert ground.aside == pytest.approx(-0.2 * math.sin(yaw))


def test_the_nose_rises_as_soon_as_the_front_wheels_are_on_the_wall(terrain):
    edge = floor_edge(terrain)
    before = Pose(edge - ROVER.front_axle - 0.01, 100.0, 0.0)
    after = Pose(edge - ROVER.front_axle + 0.05, 100.0, 0.0)
    assert ground_under(before, terrain.surface_at) == FLAT
    ground = ground_under(after, terrain.surface_at)
    assert ground.pitch < 0.0 < ground.ahead
    assert ground.roll == pytest.approx(0.0, abs=1e-6)


def test_the_right_side_rises_as_soon_as_its_wheels_are_on_the_wall(terrain):
    edge = floor_edge(terrain)
    north = math.pi / 2
    before = Pose(edge - ROVER.track / 2 - 0.01, 100.0, north)
    after = Pose(edge - ROVER.track / 2 + 0.05, 100.0, north)
    assert ground_under(before, terrain.surface_at) == FLAT
    ground = ground_under(after, terrain.surface_at)
    assert ground.roll < 0.0
    assert ground.aside < 0.0


def test_the_slopes_take_the_energy_that_lifts_and_tilts_the_body(terrain):
    """Per mass and gravity: the push along the path is the height that the mass centre gains."""
    step = 1e-3
    x = np.arange(floor_edge(terrain) - 1.0, floor_edge(terrain) + 0.1, step)
    grounds = [ground_under(Pose(at, 100.0, 0.0), terrain.surface_at) for at in x]
    gained = grounds[-1].height + ROVER.mass_depth * (1.0 - math.cos(grounds[-1].pitch))
    assert sum(ground.ahead for ground in grounds) * step == pytest.approx(gained, rel=0.05)
    assert gained > 0.1


def test_the_body_stays_within_the_stops_of_the_ground_on_a_wall(terrain):
    vehicle = Vehicle(Pose(116.0, 100.0, 0.4))
    vehicle.roll_on(2.0, Controls())
    steepest = 0.0
    for _ in range(200):
        ground = ground_under(vehicle.pose, terrain.surface_at)
        vehicle.step(Controls(), ground)
        assert abs(vehicle.pose.pitch - ground.pitch) <= ROVER.pitch_stop + 1e-12
        assert abs(vehicle.pose.roll - ground.roll) <= ROVER.roll_stop + 1e-12
        steepest = min(steepest, vehicle.pose.pitch)
    assert steepest < -5 * ROVER.pitch_stop


def test_a_wall_stops_a_coasting_rover_as_recorded(terrain):
    """Head on at 2.0 m/s: recorded with the nose 23 degrees up, and rolling back at 1.6 m/s."""
    vehicle = Vehicle(Pose(116.0, 100.0, 0.0))
    vehicle.roll_on(2.0, Controls())
    states = []
    for _ in range(200):
        vehicle.step(Controls(), ground_under(vehicle.pose, terrain.surface_at))
        states.append((math.degrees(vehicle.pose.pitch), vehicle.speed))
    pitch, speed = np.min(states, axis=0)
    assert pitch == pytest.approx(-23.0, abs=8.0)
    assert speed == pytest.approx(-1.6, abs=0.2)
