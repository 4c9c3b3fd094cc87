"""Classic A, rule by rule, on made frames."""

from __future__ import annotations

import math

import numpy as np
import pytest
from classic_frames import (
    AWAY,
    STEP,
    ClassicMission,
    driving,
    ground,
    no_floor,
    open_floor,
    patch,
    rock_at,
)
from frames_by_hand import PLAN
from maps import MIDDLE

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.classic import rules_a as rules
from rover_decision.missions.sample_return.classic.memory_a import (
    PUSH_SECONDS,
    PositionMemory,
    PushTimer,
)
from rover_decision.types import Request

HARD = ROVER.max_steering


def few(x, y):
    """Fewer cells than it stops at."""
    return patch(2.0, 0.0, rules.STOP_FORWARD - 1)(x, y)


def some(x, y):
    """More cells than it stops at, fewer than it goes on with."""
    return patch(2.0, 0.0, rules.GO_FORWARD - 1)(x, y)


class TestWallFollowing:
    def test_half_the_85th_percentile_and_two_fifths_of_the_mean(self):
        of = ground(lambda x, y: y > -1.0)
        percentile, mean = np.percentile(of.bearings, 85), of.bearings.mean()
        assert rules.wall_bearing(of) == pytest.approx(0.5 * percentile + 0.4 * mean)

    def test_open_ground_leads_to_the_left(self):
        assert rules.wall_bearing(ground()) > math.radians(10.0)

    def test_the_bearing_itself_is_the_steering_clipped_to_15_degrees(self):
        ahead = ground(lambda x, y: np.abs(y) < 0.5)
        command = rules.follow_wall(ahead, 1.0, held=0.0)
        assert command.steering_angle == pytest.approx(rules.wall_bearing(ahead))
        assert rules.follow_wall(ground(), 1.0, held=0.0).steering_angle == HARD

    def test_throttle_up_to_the_top_speed_and_coasting_beyond(self):
        assert rules.follow_wall(ground(), 2.9, 0.0).throttle == 0.3
        fast = rules.follow_wall(ground(), 3.1, 0.0)
        assert (fast.throttle, fast.brake) == (0.0, 0.0)

    def test_while_it_rolls_back_the_steering_is_held(self):
        assert rules.follow_wall(ground(), -0.5, held=-0.1).steering_angle == -0.1


class TestStop:
    def test_too_few_cells_stop_it(self):
        assert rules.is_blocked(ground(few))
        assert not rules.is_blocked(ground(patch(2.0, 0.0, rules.STOP_FORWARD)))
        assert rules.is_blocked(ground(no_floor))

    def test_ground_that_is_all_near_stops_it(self):
        near = ground(lambda x, y: np.hypot(x, y) < 1.2)
        assert near.cells > 50
        assert rules.is_blocked(ground(lambda x, y: np.hypot(x, y) < 1.4))

    def test_it_brakes_until_it_is_slow_and_then_backs_out(self):
        mission = driving("classic_a")
        fast = mission.tick(few, speed=1.0)
        assert (fast.state, fast.command.brake, fast.command.throttle) == (State.STOP, 10.0, 0.0)
        slow = mission.tick(few, speed=0.1)
        assert (slow.command.brake, slow.command.throttle) == (0.0, -2.0)

    def test_it_backs_out_with_the_wheels_to_the_leftmost_ground(self):
        right = rules.three_point_turn(ground(patch(3.0, -2.5, 100)))
        assert (right.throttle, right.steering_angle) == (-2.0, -HARD)
        ahead = rules.three_point_turn(ground(patch(3.0, 0.0, 20)))
        assert 0.0 < ahead.steering_angle < HARD
        assert rules.three_point_turn(ground(no_floor)).steering_angle == HARD

    def test_it_goes_on_with_enough_ground(self):
        mission = driving("classic_a")
        mission.tick(few)
        assert mission.tick(some).state is State.STOP
        assert mission.tick(patch(2.0, 0.0, rules.GO_FORWARD)).state is State.FORWARD

    def test_it_sets_out_with_the_mean_bearing_while_it_rolls_back(self):
        mission = driving("classic_a")
        mission.tick(few)
        left = patch(4.0, 0.5, 1000)
        set_out = mission.tick(left, speed=-0.5)
        assert set_out.command.steering_angle == pytest.approx(ground(left).mean_bearing())
        assert set_out.command.throttle > 0


class TestStuck:
    def test_fifteen_nearly_equal_positions_are_stuck(self):
        memory = PositionMemory()
        for index in range(15):
            assert not memory.stuck
            memory.add(Pose(100.0 + 0.0003 * (index == 3), 100.0, 0.0))
        assert memory.stuck
        memory.add(Pose(100.02, 100.0, 0.0))
        assert memory.stuck  # two places
        memory.add(Pose(100.05, 100.0, 0.0))
        assert not memory.stuck

    @pytest.mark.parametrize("floor", [open_floor, few], ids=["forward", "stop"])
    def test_it_reverses_with_turned_wheels_whatever_the_state(self, floor):
        mission = driving("classic_a")
        decision = mission.ticks(16 * STEP, floor=floor, moves=0.0)[-1]
        assert decision.state is State.STUCK
        assert (decision.command.throttle, decision.command.steering_angle) == (-3.0, HARD)
        assert decision.progress.recoveries == 1

    def test_it_goes_on_in_its_state_when_it_moves(self):
        mission = driving("classic_a")
        mission.tick(few)
        mission.ticks(16 * STEP, floor=few, moves=0.0)
        moving = mission.ticks(16 * STEP, floor=some, moves=-0.05)
        assert [made.state for made in moving[:10]] == [State.STUCK] * 10
        assert moving[-1].state is State.STOP


class TestPush:
    def test_it_is_due_every_15_seconds(self):
        timer = PushTimer()
        timer.update(2.0)
        assert not timer.due(17.0)
        assert timer.due(17.1)
        timer.pushed(17.1)
        assert not timer.due(32.0)

    @pytest.mark.parametrize(
        ("floor", "rock", "state"),
        [
            (open_floor, None, State.FORWARD),
            (few, None, State.STOP),
            (open_floor, rock_at((5.0, 0.0)), State.ROCK_APPROACH),
        ],
    )
    def test_it_pushes_straight_ahead_whatever_the_state(self, floor, rock, state):
        mission = driving("classic_a")
        decisions = mission.ticks(17.0, floor=floor, rock=rock)
        pushes = [index for index, made in enumerate(decisions) if made.state is State.CIRCLE]
        command = decisions[pushes[0]].command
        assert (command.throttle, command.steering_angle, command.brake) == (1.0, 0.0, 0.0)
        assert decisions[pushes[0] - 1].state is decisions[pushes[-1] + 1].state is state
        assert len(pushes) == pytest.approx(PUSH_SECONDS / STEP, abs=1)

    def test_it_pushes_also_when_it_is_stuck(self):
        mission = driving("classic_a")
        states = [decision.state for decision in mission.ticks(16.0, moves=0.0)]
        assert State.CIRCLE in states
        assert states[states.index(State.CIRCLE) - 1] is State.STUCK


class TestRocks:
    def test_a_rock_in_view_comes_before_the_ground(self):
        mission = driving("classic_a")
        decision = mission.tick(few, rock=rock_at((4.0, 1.0), (4.0, 0.5)))
        assert decision.state is State.ROCK_APPROACH
        mean = (math.atan2(1.0, 4.0) + math.atan2(0.5, 4.0)) / 2
        assert decision.command.steering_angle == pytest.approx(mean, abs=1e-5)
        assert decision.command.throttle == 0.2

    def test_it_is_approached_at_a_metre_a_second(self):
        mission = driving("classic_a")
        assert mission.tick(rock=rock_at((4.0, 0.0)), speed=1.2).command.throttle == 0.0

    def test_when_it_is_gone_the_state_before_goes_on(self):
        mission = driving("classic_a")
        mission.tick(few)
        mission.tick(some, rock=rock_at((4.0, 0.0)))
        assert mission.tick(some).state is State.STOP

    def test_in_reach_it_is_picked_up_standing(self):
        mission = driving("classic_a")
        rolling = mission.tick(rock=rock_at((0.8, 0.0)), near_sample=True, speed=0.8)
        assert (rolling.state, rolling.command.pickup) == (State.PICKUP, False)
        assert mission.tick(near_sample=True).command.pickup
        mission.tick(near_sample=True, picking_up=True)
        assert mission.tick(sample_count=2).state is State.FORWARD


class TestHome:
    def test_all_samples_lead_home(self):
        assert driving("classic_a").tick(sample_count=0).state is State.RETURN_HOME

    def test_98_percent_lead_home_as_well(self):
        mission = driving("classic_a", complete_at=0.5)
        assert mission.tick(plan=PLAN).state is State.RETURN_HOME
        assert driving("classic_a").tick(plan=PLAN).state is State.FORWARD

    def test_it_drives_to_the_last_breadcrumb_with_its_bearing(self):
        mission = ClassicMission("classic_a")
        for step in range(100):
            mission.tick(pose=Pose(MIDDLE.x + 0.25 * step, MIDDLE.y, 0.0))
        mission.request(Request.RETURN_HOME)
        back = Pose(MIDDLE.x + 25.0, MIDDLE.y, math.pi - 0.1)
        decision = mission.tick(pose=back)
        assert decision.state is State.RETURN_HOME
        assert decision.command.steering_angle == pytest.approx(0.1, abs=0.05)
        assert decision.command.throttle == 0.3

    def test_without_ground_ahead_it_reverses_with_the_opposite_steering(self):
        ahead = rules.homeward(ground(), 1.0, 0.2)
        back = rules.homeward(ground(few), 1.0, 0.2)
        assert (ahead.throttle, ahead.steering_angle) == (0.3, pytest.approx(0.2))
        assert (back.throttle, back.steering_angle) == (-2.0, pytest.approx(-0.2))
        rolls_back = rules.homeward(ground(), -0.5, 0.2)
        assert (rolls_back.throttle, rolls_back.steering_angle) == (0.3, pytest.approx(-0.2))

    def test_a_rock_on_the_way_is_still_picked_up(self):
        mission = driving("classic_a", complete_at=0.5)
        mission.tick(plan=PLAN)
        assert mission.tick(rock=rock_at((4.0, 0.0))).state is State.ROCK_APPROACH
        assert mission.tick().state is State.RETURN_HOME

    def test_within_two_metres_it_is_done(self):
        mission = driving("classic_a")
        mission.request(Request.RETURN_HOME)
        mission.tick(pose=AWAY)
        near = Pose(MIDDLE.x + 2.1, MIDDLE.y, 0.0)
        assert mission.tick(pose=near).state is State.RETURN_HOME
        assert mission.tick(pose=Pose(MIDDLE.x + 1.9, MIDDLE.y, 0.0)).state is State.DONE
        assert mission.tick(pose=MIDDLE).command.brake > 0
