"""Classic B, rule by rule, on made frames."""

from __future__ import annotations

import math

import numpy as np
import pytest
from classic_frames import (
    AWAY,
    REACH,
    STEP,
    ClassicMission,
    driving,
    ground,
    patch,
    rock_at,
)
from maps import MIDDLE

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.classic import rules_b as rules
from rover_decision.types import Request

HARD = ROVER.max_steering
TEN_DEGREES = math.radians(10.0)


def view(floor) -> rules.View:
    return rules.View.of(ground(floor))


def strip(left: float, right: float):
    """Floor up to so far [m] to either side."""
    return lambda x, y: (y < left) & (y > -right)


def few(x, y):
    """Fewer cells than it stops at."""
    return patch(2.0, 0.0, rules.STOP_FORWARD - 1)(x, y)


def some(x, y):
    """Fewer cells than it goes on with."""
    return patch(2.0, 0.0, rules.GO_FORWARD - 1)(x, y)


class TestStop:
    def test_too_few_cells_stop_it_and_it_turns_right_in_place(self):
        mission = driving("classic_b")
        fast = mission.tick(few, speed=1.0)
        assert (fast.state, fast.command.brake) == (State.STOP, 10.0)
        slow = mission.tick(few, speed=0.1).command
        assert (slow.throttle, slow.brake, slow.steering_angle) == (0.0, 0.0, -HARD)

    def test_it_goes_on_with_enough_ground(self):
        mission = driving("classic_b")
        mission.tick(few)
        assert mission.tick(some).state is State.STOP
        assert mission.tick(patch(2.0, 0.0, rules.GO_FORWARD)).state is State.FORWARD

    def test_it_is_not_done_by_a_rock(self):
        mission = driving("classic_b")
        mission.tick(few)
        assert mission.tick(few, rock=rock_at((3.0, 0.0))).state is State.STOP


class TestRocks:
    def test_the_nearest_rock_cell_leads(self):
        two = rock_at((4.0, -2.0), (2.0, 1.0), (5.0, 0.0))
        assert rules.nearest_rock(two) == pytest.approx(math.atan2(1.0, 2.0))
        assert rules.nearest_rock(rock_at()) is None
        assert rules.nearest_rock(rock_at((5.1, 0.0))) is None

    def test_it_brakes_once_and_rolls_to_the_rock(self):
        mission = driving("classic_b")
        rock = rock_at((4.0, 0.5))
        first = mission.tick(rock=rock, speed=1.5)
        assert (first.state, first.command.brake) == (State.ROCK_APPROACH, 10.0)
        second = mission.tick(rock=rock, speed=1.2).command
        assert (second.brake, second.throttle) == (0.0, 0.0)
        assert second.steering_angle == pytest.approx(math.atan2(0.5, 4.0))

    def test_it_creeps_on_when_the_rock_lies_ahead_and_turns_in_place_when_aside(self):
        ahead, aside = rules.to_rock(0.1, 0.3), rules.to_rock(-0.5, 0.0)
        assert (ahead.throttle, ahead.steering_angle) == (0.2, 0.1)
        assert rules.to_rock(0.1, 0.6).throttle == 0.0
        assert (aside.throttle, aside.brake, aside.steering_angle) == (0.0, 0.0, -HARD)

    def test_a_rock_out_of_sight_is_steered_to_as_before(self):
        mission = driving("classic_b")
        mission.tick(rock=rock_at((4.0, 0.5)))
        before = mission.tick(rock=rock_at((4.0, 0.5)), speed=1.0).command
        after = mission.tick(speed=1.0)
        assert (after.state, after.command) == (State.ROCK_APPROACH, before)

    def test_in_reach_it_is_picked_up_and_the_wall_followed_again(self):
        mission = driving("classic_b")
        mission.tick(rock=rock_at((2.0, 0.0)))
        assert mission.tick(near_sample=True).state is State.PICKUP
        assert mission.tick(near_sample=True).command.pickup
        mission.tick(near_sample=True, picking_up=True)
        assert mission.tick(sample_count=2).state is State.FORWARD


class TestHome:
    def test_all_samples_lead_home_and_nothing_else(self):
        assert driving("classic_b").tick(sample_count=0).state is State.RETURN_HOME
        assert driving("classic_b").tick(sample_count=1).state is State.FORWARD

    def test_the_bearing_closest_to_homes_in_the_middle_half(self):
        even = view(strip(1.5, 1.5))
        low, high = np.percentile(even.near.bearings, (25, 75))
        assert rules.bearing_home(even, 2.0) == pytest.approx(high)
        assert rules.bearing_home(even, -2.0) == pytest.approx(low)
        assert rules.bearing_home(even, 0.05) == 0.05

    def test_sides_come_before_home(self):
        tight = rules.careful_drive(view(strip(0.0, 3.0)), 1.0, rules.HOMEWARD, home=1.0)
        assert tight.steering_angle == -HARD

    def test_it_drives_towards_home(self):
        mission = driving("classic_b", way_home="bearing")
        mission.request(Request.RETURN_HOME)
        pose = Pose(AWAY.x, AWAY.y, math.pi - 0.05)
        command = mission.tick(strip(1.5, 1.5), pose=pose).command
        assert command.steering_angle == pytest.approx(0.05, abs=1e-6)

    def test_it_stops_and_turns_on_the_way_as_well(self):
        mission = driving("classic_b")
        mission.request(Request.RETURN_HOME)
        mission.tick()
        assert mission.tick(few, speed=1.0).command.brake == 10.0
        assert mission.tick(some).command.steering_angle == -HARD
        assert mission.tick().command.throttle > 0

    def test_within_two_metres_it_is_done(self):
        mission = driving("classic_b")
        mission.request(Request.RETURN_HOME)
        mission.tick(pose=AWAY)
        assert mission.tick(pose=Pose(MIDDLE.x + 1.9, MIDDLE.y, 0.0)).state is State.DONE


class TestWishes:
    def picked_up(self, **parameters) -> ClassicMission:
        mission = driving("classic_b", **parameters)
        mission.tick(rock=rock_at((2.0, 0.0)))
        mission.tick(near_sample=True)
        mission.tick(near_sample=True, picking_up=True)
        return mission

    def test_a_left_turn_after_a_pickup(self):
        mission = self.picked_up(turn_after_pickup=True)
        turns = mission.ticks(3.0, sample_count=2, moves=0.0, floor=strip(1.5, 1.5))
        in_place = [made for made in turns if made.command.steering_angle == HARD]
        assert len(in_place) == round(2.0 / STEP)
        assert all(made.command.throttle == 0.0 for made in in_place)
        assert self.picked_up().tick(strip(1.5, 1.5), sample_count=2).command.throttle > 0

    def test_visited_ground_counts_less(self):
        def steering(avoid: float) -> float:
            mission = driving("classic_b", avoid_visited=avoid)
            for step in range(20):  # along what will lie to the left
                mission.tick(pose=Pose(AWAY.x + 0.5 * step, AWAY.y + 2.0, 0.0))
            return mission.tick(strip(2.0, 2.0), pose=AWAY).command.steering_angle

        assert steering(0.0) == pytest.approx(TEN_DEGREES, abs=0.01)
        assert steering(0.8) < steering(0.4) < steering(0.0)

    def test_the_view_reaches_as_far_as_the_ground(self):
        assert view(strip(1.0, 1.0)).ground.ranges.max() == pytest.approx(REACH, abs=0.2)
