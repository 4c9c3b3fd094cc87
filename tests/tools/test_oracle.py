"""The oracle in worlds small enough to work its trip out by hand."""

import math

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_simulator.world.generator import generate_world
from rover_simulator.world.world import World
from rover_tools.evaluation.oracle.ground import OracleGround
from rover_tools.evaluation.oracle.top_speed import leg_seconds
from rover_tools.evaluation.oracle.tour import SIGHT, oracle_tour


def world_of(*rooms: tuple[slice, slice], start: tuple[float, float], samples=()) -> World:
    navigable = np.zeros((200, 200), bool)
    for room in rooms:
        navigable[room] = True
    return World("drawn", navigable, np.array(samples, float).reshape(-1, 2), Pose(*start, 0.0))


def corridor(length: int, samples=()) -> World:
    """One cell wide, eastward; the start is in its first cell."""
    return world_of(np.s_[50:51, 20 : 20 + length], start=(20.5, 50.5), samples=samples)


def hand_made_leg(metres: float) -> float:
    """By the vehicle's constants: dv/dt = 0.852 - 0.0574 v up to 5 m/s, then 7 m/s^2 of brake."""
    drive, coast, top, brake = 0.852, 0.0574, 5.0, 7.0
    accelerating = -math.log(1 - top * coast / drive) / coast
    distance = (drive * accelerating - top) / coast
    braking = math.log(1 + top * coast / brake) / coast
    stop = (top - brake * braking) / coast
    return accelerating + braking + (metres - distance - stop) / top


@pytest.mark.parametrize("metres", [30.0, 100.0, 400.0])
def test_a_leg_at_top_speed_takes_what_the_constants_say(metres):
    assert leg_seconds(metres) == pytest.approx(hand_made_leg(metres), rel=0.01)


def test_a_short_leg_does_not_reach_top_speed():
    # One metre: at 0.852 m/s^2 to v and with 7 m/s^2 to a stand, v^2 (1/0.852 + 1/7) = 2
    top = math.sqrt(2.0 / (1 / 0.852 + 1 / 7.0))
    assert leg_seconds(1.0) == pytest.approx(top / 0.852 + top / 7.0, rel=0.05)
    assert leg_seconds(0.0) == 0.0


def test_a_corridor_with_a_sample_at_its_end_is_there_and_back():
    tour = oracle_tour(corridor(31, samples=[(50.5, 50.5)]))
    assert tour.metres == pytest.approx(60.0)
    assert tour.seconds == pytest.approx(2 * leg_seconds(30.0) + ROVER.pickup_seconds)
    assert tour.path[0].tolist() == tour.path[-1].tolist() == [20.5, 50.5]


def test_a_corridor_without_samples_is_driven_until_its_end_is_seen():
    tour = oracle_tour(corridor(41))
    assert tour.metres == pytest.approx(2 * (40 - SIGHT))
    assert tour.seconds == pytest.approx(leg_seconds(tour.metres))


def test_what_is_in_sight_from_the_start_costs_nothing():
    tour = oracle_tour(world_of(np.s_[50:56, 50:56], start=(52.5, 52.5)))
    assert (tour.seconds, tour.metres) == (0.0, 0.0)


def test_each_sample_takes_its_time_even_in_one_cell():
    one, two = (oracle_tour(corridor(9, [(25.5, 50.5)] * count)) for count in (1, 2))
    assert two.seconds - one.seconds == pytest.approx(ROVER.pickup_seconds)


def test_walls_are_not_seen_through():
    arms = (np.s_[50:51, 20:31], np.s_[54:55, 20:31], np.s_[50:55, 30:31])
    ground = OracleGround(world_of(*arms, start=(20.5, 50.5)).navigable, (20.5, 50.5))
    sees = ground.sight(16.0)
    here, opposite, corner = (ground.nearest(p) for p in ((20.5, 50.5), (20.5, 54.5), (30.5, 50.5)))
    assert not sees[here, opposite]
    assert sees[here, corner]
    assert sees[corner, here]


def test_ground_out_of_reach_does_not_count():
    there = oracle_tour(world_of(np.s_[50:51, 20:30], np.s_[90:99, 90:99], start=(20.5, 50.5)))
    assert there.metres == 0.0


def test_paths_do_not_cut_corners():
    arms = (np.s_[50:51, 20:26], np.s_[50:56, 25:26])
    ground = OracleGround(world_of(*arms, start=(20.5, 50.5)).navigable, (20.5, 50.5))
    metres, _ = ground.paths_from([ground.nearest((20.5, 50.5))])
    assert metres[0, ground.nearest((25.5, 55.5))] == pytest.approx(10.0)


def test_in_a_canyon_all_ground_is_seen_and_all_samples_are_visited():
    world = generate_world(2, 0.4)
    tour = oracle_tour(world)
    ground = OracleGround(world.navigable, (world.start.x, world.start.y))
    path = [ground.nearest((x, y)) for x, y in tour.path]
    assert ground.sight(SIGHT)[path].any(axis=0).all()
    assert {ground.nearest((x, y)) for x, y in world.samples} <= set(path)
    steps = np.hypot(*np.diff(tour.path, axis=0).T)
    assert steps.sum() == pytest.approx(tour.metres)
    again = oracle_tour(world)
    assert again.seconds == tour.seconds
    assert again.path.tolist() == tour.path.tolist()
