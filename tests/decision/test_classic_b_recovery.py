"""Classic B: stuck and circle, on made frames."""

from __future__ import annotations

import math

import numpy as np
import pytest
from classic_frames import (
    AWAY,
    driving,
    ground,
    no_floor,
    patch,
    rock_at,
)

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.classic import rules_b as rules
from rover_decision.missions.sample_return.classic.memory_b import Occasions, TravelCheck
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


class TestStuck:
    def test_a_metre_in_ten_seconds_is_looked_for_every_ten_seconds(self):
        check = TravelCheck()
        check.update(0.0, AWAY)
        check.update(9.9, AWAY)
        assert not check.stands
        check.update(10.0, Pose(AWAY.x + 0.9, AWAY.y, 0.0))
        assert check.stands
        check.update(20.0, Pose(AWAY.x + 2.0, AWAY.y, 0.0))
        assert not check.stands

    def test_the_manoeuvre_backs_up_brakes_turns_and_drives_out(self):
        wide = view(strip(3.0, 0.5))
        back, brake = rules.unstuck(wide, 0.0, 5.9), rules.unstuck(wide, 0.0, 6.1)
        turn, out = rules.unstuck(wide, 0.0, 7.5), rules.unstuck(wide, 0.0, 8.1)
        assert (back.throttle, back.steering_angle) == (-1.0, 0.0)
        assert (brake.throttle, brake.brake) == (0.0, 10.0)
        assert (turn.throttle, turn.brake, turn.steering_angle) == (0.0, 0.0, HARD)
        assert out.throttle == 1.0
        assert rules.unstuck(wide, 2.1, 8.1).throttle == 0.0  # up to 2 m/s
        assert rules.unstuck(wide, 0.0, 13.0 + 5.9) == back  # and repeats

    def test_it_turns_to_the_side_with_much_more_ground_else_right(self):
        assert rules.wide_side(ground(strip(3.0, 0.5))) == HARD
        assert rules.wide_side(ground(strip(1.0, 1.0))) == -HARD
        assert rules.wide_side(ground(no_floor)) == -HARD

    def test_it_lasts_until_two_metres_away_and_at_least_the_whole_manoeuvre(self):
        mission = driving("classic_b")
        mission.ticks(21.0, moves=0.0)
        assert mission.state is State.STUCK
        mission.ticks(13.5, moves=0.0)
        assert mission.state is State.STUCK
        mission.tick(pose=Pose(AWAY.x + 2.1, AWAY.y, 0.0))
        assert mission.state is State.FORWARD

    def test_a_rock_is_nothing_to_it_meanwhile(self):
        mission = driving("classic_b")
        mission.ticks(21.0, moves=0.0)
        assert mission.tick(rock=rock_at((3.0, 0.0))).state is State.STUCK

    def test_after_a_pickup_to_stand_is_no_wonder(self):
        occasions = Occasions()
        assert occasions.may_be_stuck(5.0)
        occasions.pickup = 5.0
        assert not occasions.may_be_stuck(24.9)
        assert occasions.may_be_stuck(25.0)


class TestCircle:
    def steered(self, **last: float) -> Occasions:
        """Steered left by nine degrees for ten seconds, at the time 100."""
        occasions = Occasions()
        occasions.steered(90.0, 0.0)
        for time in np.arange(90.1, 100.0, 0.1):
            occasions.steered(time, math.radians(9.0))
        for name, time in last.items():
            setattr(occasions, name, time)
        return occasions

    def test_ten_seconds_of_more_than_eight_degrees_are_a_circle(self):
        occasions = self.steered()
        assert not occasions.circles(99.9)
        assert occasions.circles(100.0)
        occasions.steered(100.0, math.radians(-8.0))
        assert not occasions.circles(100.1)

    @pytest.mark.parametrize(
        ("what", "seconds"), [("pickup", 20.0), ("stop", 10.0), ("stuck", 10.0)]
    )
    def test_not_soon_after_something_else(self, what, seconds):
        assert not self.steered(**{what: 100.1 - seconds}).circles(100.0)
        assert self.steered(**{what: 100.0 - seconds}).circles(100.0)

    def test_it_brakes_and_follows_the_mean_for_ten_seconds(self):
        mission = driving("classic_b")
        left = strip(2.0, 1.9)
        decisions = mission.ticks(10.5, floor=left)
        first = next(made for made in decisions if made.state is State.CIRCLE)
        assert first.command.brake == 10.0
        assert mission.tick(left).command.steering_angle < TEN_DEGREES / 2
        mission.ticks(10.0, floor=left)
        assert mission.state is State.FORWARD

    def test_not_on_the_way_home(self):
        mission = driving("classic_b")
        mission.request(Request.RETURN_HOME)
        states = {made.state for made in mission.ticks(12.0, moves=0.1, floor=strip(3.0, 0.0))}
        assert states == {State.RETURN_HOME}
