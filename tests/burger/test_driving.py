"""How the robot moves: against what it is told, against walls, and on the ramp."""

from __future__ import annotations

import math

import pytest
from worlds import ramp_ahead, square

from burger_simulator.options import BurgerOptions
from burger_simulator.simulation import BurgerSimulation
from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import SensorErrors
from rover_common.geometry import Pose
from rover_common.sensor_types import Twist

SLOPE = math.atan2(0.06, 0.50)


def drive(simulation: BurgerSimulation, twist: Twist, seconds: float) -> None:
    for _ in range(round(seconds / 0.05)):
        simulation.step(twist)


def test_it_stands_still_untold():
    simulation = BurgerSimulation(square())
    drive(simulation, Twist(), 5.0)
    pose = simulation.truth.pose
    assert math.hypot(pose.x, pose.y) < 1e-3
    assert abs(pose.yaw) < 1e-3
    assert simulation.truth.distance < 1e-3


def test_it_drives_straight_as_fast_as_it_is_told():
    simulation = BurgerSimulation(square(5.0))
    drive(simulation, Twist(0.2), 1.0)
    start = simulation.truth.pose
    drive(simulation, Twist(0.2), 5.0)
    pose = simulation.truth.pose
    assert pose.x - start.x == pytest.approx(1.0, rel=0.02)
    assert abs(pose.y) < 0.005
    assert simulation.truth.speed == pytest.approx(0.2, rel=0.02)


@pytest.mark.parametrize("rate", [1.8, -1.0])
def test_it_turns_on_the_spot_as_fast_as_it_is_told(rate):
    simulation = BurgerSimulation(square())
    drive(simulation, Twist(0.0, rate), 3.0)
    assert simulation.truth.turn_rate == pytest.approx(rate, rel=0.03)
    pose = simulation.truth.pose
    assert math.hypot(pose.x, pose.y) < 0.01


def test_wheels_of_other_sizes_drive_other_ways():
    errors = SensorErrors(wheel_separation_scale=1.01, wheel_radius_scale=0.995)
    nominal, other = BurgerSimulation(square(9.0)), BurgerSimulation(square(9.0, errors=errors))
    for simulation in (nominal, other):
        drive(simulation, Twist(0.2, 0.0), 3.0)
    ratio = other.truth.pose.x / nominal.truth.pose.x
    assert ratio == pytest.approx(0.995, abs=0.001)
    for simulation in (nominal, other):
        drive(simulation, Twist(0.0, 1.0), 3.0)
    ratio = other.truth.pose.yaw / nominal.truth.pose.yaw
    assert ratio == pytest.approx(0.995 / 1.01, abs=0.003)


def test_velocities_are_clamped_to_the_motors():
    simulation = BurgerSimulation(square(5.0))
    drive(simulation, Twist(3.0), 2.0)
    assert simulation.truth.speed == pytest.approx(0.22, rel=0.03)


def test_a_twist_is_held_for_half_a_second():
    simulation = BurgerSimulation(square(5.0))
    simulation.step(Twist(0.2))
    for _ in range(9):
        simulation.step()
    assert simulation.truth.speed > 0.18
    for _ in range(8):
        simulation.step()
    assert abs(simulation.truth.speed) < 0.01


def test_it_stops_within_a_quarter_of_a_second():
    simulation = BurgerSimulation(square(5.0))
    drive(simulation, Twist(0.2), 2.0)
    drive(simulation, Twist(), 0.25)
    assert abs(simulation.truth.speed) < 0.02
    assert simulation.truth.pose.pitch == pytest.approx(0.0, abs=0.02)


def test_a_wall_stops_it_and_is_counted_once():
    simulation = BurgerSimulation(square(0.5))
    drive(simulation, Twist(0.2), 4.0)
    truth = simulation.truth
    assert (truth.contacts, truth.touching) == (1, True)
    assert 0.5 - truth.pose.x == pytest.approx(0.15 + 0.0025, abs=0.005)
    drive(simulation, Twist(-0.1), 1.0)
    assert not simulation.truth.touching
    drive(simulation, Twist(0.2), 2.0)
    assert simulation.truth.contacts == 2


def test_the_body_with_corners_touches_where_the_disc_does_not():
    """Beside a wall, 0.17 m away, the disc turns free and the corner of the box does not."""
    maze = square(0.5, start=Pose(0.33, 0.0, math.pi / 2))
    disc, box = BurgerSimulation(maze), BurgerSimulation(maze, options=BurgerOptions(box_body=True))
    for simulation in (disc, box):
        drive(simulation, Twist(0.0, 1.0), 4.0)
    assert disc.truth.contacts == 0
    assert box.truth.contacts > 0


def test_it_climbs_the_ramp_and_stands_on_its_flat_part():
    simulation = BurgerSimulation(square(2.0, ramp=ramp_ahead(0.5)))
    drive(simulation, Twist(0.0), 1.0)
    level = simulation.truth.pose.pitch
    assert level == pytest.approx(-math.atan2(0.001, 0.081), abs=0.001)
    drive(simulation, Twist(0.15), 3.0)
    assert simulation.truth.beyond_foot == 0.0
    drive(simulation, Twist(0.15), 2.5)
    truth = simulation.truth
    assert 0.1 < truth.beyond_foot < 0.45
    assert truth.pose.pitch == pytest.approx(level - SLOPE, abs=0.003)
    assert truth.z == pytest.approx(truth.beyond_foot * 0.12, abs=0.003)
    assert not truth.on_flat
    while not simulation.truth.on_flat:
        assert simulation.time < 12.0
        simulation.step(Twist(0.15))
    drive(simulation, Twist(), 1.0)
    truth = simulation.truth
    assert truth.on_flat
    assert truth.z == pytest.approx(0.06, abs=0.001)
    assert truth.pose.pitch == pytest.approx(level, abs=0.002)
    assert (truth.contacts, truth.ramp_contacts) == (0, 0)


def test_a_slope_does_not_slow_it():
    simulation = BurgerSimulation(square(2.0, ramp=ramp_ahead(0.3)))
    drive(simulation, Twist(0.15), 2.0)
    drive(simulation, Twist(0.15), 2.5)
    assert simulation.truth.beyond_foot > 0.1
    assert simulation.truth.speed == pytest.approx(0.15, rel=0.01)


def test_it_stands_on_the_slope_without_rolling_back():
    simulation = BurgerSimulation(square(2.0, ramp=ramp_ahead(0.3)))
    drive(simulation, Twist(0.15), 4.0)
    drive(simulation, Twist(), 0.5)
    before = simulation.truth.beyond_foot
    drive(simulation, Twist(), 3.0)
    assert simulation.truth.beyond_foot == pytest.approx(before, abs=0.005)


def test_the_side_of_the_ramp_stops_it_and_is_a_touch_of_the_ramp():
    start = Pose(1.0, -0.6, math.pi / 2)  # beside the flat part
    simulation = BurgerSimulation(square(2.0, start=start, ramp=ramp_ahead(0.4)))
    drive(simulation, Twist(0.2), 4.0)
    truth = simulation.truth
    assert (truth.contacts, truth.ramp_contacts) == (0, 1)
    assert truth.pose.y == pytest.approx(-0.25 - 0.15, abs=0.01)
    assert truth.beyond_foot == 0.0


def test_generated_ramps_are_climbed_from_their_foot_without_a_touch():
    for seed in range(3):
        maze = generate_maze(seed)
        ramp = maze.ramp
        x = ramp.x - 0.5 * math.cos(ramp.yaw)
        y = ramp.y - 0.5 * math.sin(ramp.yaw)
        world = type(maze)(**(vars(maze) | {"start": Pose(x, y, ramp.yaw)}))
        simulation = BurgerSimulation(world, seed)
        while not simulation.truth.on_flat:
            assert simulation.time < 12.0
            simulation.step(Twist(0.15))
        assert (simulation.truth.contacts, simulation.truth.ramp_contacts) == (0, 0)
