"""A new run starts everything anew, and nothing but a new run does."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from cores import CoreBench
from frames_by_hand import AWAY, CONFIG, PLAN, TILTED, frame, nanoseconds, rock
from maps import HALL, MIDDLE, UNKNOWN, straight_plan

from rover_common.geometry import Pose
from rover_decision.missions.sample_return.chart import State
from rover_decision.types import Decision, Request
from rover_navigation.types import GoalKind, PlanRequest

LEFT = straight_plan(pose=Pose(MIDDLE.x, MIDDLE.y, np.pi / 2))


class TestPlansOfTheRunBefore:
    """Run 1 ends at 501.5 s with a plan in force; run 2 follows at once."""

    @pytest.fixture
    def driving(self, bench):
        bench.time = 499.5
        decisions = bench.steps(2.0)
        assert decisions[-1].command.throttle > 0
        return bench

    def test_no_frame_of_the_new_run_is_decided_with_an_old_plan(self, driving):
        driving.begin_run()
        driving.maps = False
        for _ in range(8):  # 1.75 s
            decision = driving.step(0.25, map_age=100.0)  # no map is due yet
            assert decision.command.brake == 1.0
            assert driving.core.mission.overlay().plan is None

    def test_nor_with_one_that_was_in_the_making(self, make_bench):
        bench = make_bench(lockstep=True)
        bench.steps(1.0)
        bench.planner.gate.clear()
        bench.step()
        bench.begin_run()
        bench.maps = False
        bench.step()
        bench.planner.gate.set()
        for decision in bench.steps(2.0, map_age=0.05):
            assert decision.command.brake == 1.0
            assert bench.core.mission.overlay().plan is None

    def test_a_late_map_of_the_old_run_serves_no_order_of_the_new_one(self, driving):
        old_stamp = nanoseconds(driving.time - 0.1)
        driving.begin_run()
        driving.maps = False
        first = driving.time
        driving.step()
        driving.core.give_map(old_stamp, HALL)
        assert driving.core.ready(nanoseconds(first + 1.0)) is not driving.lockstep
        driving.core.give_map(nanoseconds(first), UNKNOWN)
        driving.settle()
        assert driving.core.ready(nanoseconds(first + 1.0))
        driving.step_until(lambda decision: decision.command.throttle > 0, 2.0, map_age=0.05)
        requests = [made for made in driving.planner.requests if made.stamp > old_stamp]
        assert [request.grid for request in requests] == [UNKNOWN]

    def test_a_map_of_the_new_run_may_come_before_its_first_frame(self, driving):
        run = driving.begin_run()
        driving.core.give_map(run.start, HALL)
        driving.maps = False
        driving.step()
        driving.settle()
        assert driving.core.ready(run.start + nanoseconds(1.0))
        driving.step_until(lambda decision: decision.command.throttle > 0, 2.0, map_age=0.05)
        assert driving.planner.requests[-1].grid is HALL


class TestMission:
    """What it remembers ends with its run."""

    def test_a_new_run_decides_as_a_fresh_core_does(self, make_bench):
        """After a run with everything in it: samples, recoveries, blocked places, a long path."""
        used, fresh = make_bench(), make_bench()
        eventful_run(used)
        used.time = fresh.time = 600.0
        used.begin_run(), fresh.begin_run()
        for old, new in zip(third_of_a_mission(used), third_of_a_mission(fresh), strict=True):
            assert old == new
        assert_same_request(next_request(used), next_request(fresh))
        assert next_request(used).home == (AWAY.x, AWAY.y)

    def test_the_number_of_the_mission_tells_it_from_the_one_before(self, bench):
        bench.steps(1.0)
        number = bench.core.mission_number
        mission = bench.core.mission
        bench.begin_run()
        bench.step()
        assert bench.core.mission_number == number + 1
        assert bench.core.mission is not mission

    def test_a_time_limit_ends_with_its_run(self, bench):
        bench.planner.plan = dataclasses.replace(PLAN, home_seconds=np.inf)
        bench.step()
        bench.core.limit_time(30.0)
        bench.step(31.0)
        bench.steps(1.0)
        assert bench.core.state is State.RETURN_HOME or bench.core.mission.over
        bench.begin_run()
        bench.step()
        bench.step(31.0)
        assert {decision.state for decision in bench.steps(1.0)} <= {State.FORWARD, State.HOLD}


def eventful_run(bench: CoreBench) -> None:
    """A run in which the mission learns all that it can remember."""
    rocks = (rock(MIDDLE.x + 2.0, MIDDLE.y, 1),)
    bench.step(rocks=rocks)
    bench.steps(1.0, pose=TILTED)
    bench.steps(8.0)
    bench.steps(1.2 * CONFIG.rock_deadline, rocks=rocks)
    bench.step(near_sample=True)
    bench.step(picking_up=True)
    bench.step(sample_count=2)
    for step in range(100):
        bench.step(pose=Pose(MIDDLE.x + 0.2 * step, MIDDLE.y, 0.0), sample_count=2)
    progress = bench.step(pose=Pose(MIDDLE.x + 20.0, MIDDLE.y, 0.0), sample_count=2).progress
    assert min(progress.samples_collected, progress.rocks_given_up, progress.recoveries) > 0
    assert len(bench.core.mission.overlay().blocked) > 0


def third_of_a_mission(bench: CoreBench) -> list[Decision]:
    """Away from where the run before began; the rock that it gave up is there again."""
    rocks = (rock(MIDDLE.x + 20.0, MIDDLE.y, 1),)
    decisions = [bench.step(pose=AWAY, rocks=rocks, sample_count=6)]
    for step in range(80):
        pose = Pose(AWAY.x + 0.1 * step, AWAY.y, 0.0)
        decisions.append(bench.step(pose=pose, rocks=rocks, sample_count=6))
    return decisions


def next_request(bench: CoreBench) -> PlanRequest:
    """What a plan would be made of at the next frame."""
    return bench.core.mission.plan_request(frame(bench.time))(UNKNOWN)


def assert_same_request(one: PlanRequest, other: PlanRequest) -> None:
    for name in vars(one):
        a, b = getattr(one, name), getattr(other, name)
        if name == "coverage":
            assert np.array_equal(a.distance, b.distance)
        elif isinstance(a, np.ndarray):
            assert np.array_equal(a, b), name
        else:
            assert a == b, name


class TestWhatIsNoNewRun:
    @pytest.mark.parametrize(
        "later",
        [
            {"time": 1.0},  # the clock falls back
            {"time": 5000.0},
            {"time": 502.0, "pose": Pose(20.0, 20.0, 0.0)},  # somebody moved the rover
            {"time": 502.0, "sample_count": 6},
        ],
    )
    def test_frames_of_the_same_number_belong_to_the_same_mission(self, bench, later):
        bench.time = 500.0
        bench.steps(1.5)
        mission, number = bench.core.mission, bench.core.mission_number
        bench.core.step(frame(**later))
        assert bench.core.mission is mission
        assert bench.core.mission_number == number
        assert not bench.step().command.new_run


class TestReset:
    """A request to reset, and to start again when all is done, asks the bridge for a new run."""

    @pytest.fixture(params=[Request.RESET, Request.START], ids=["reset", "start again"])
    def asked(self, bench, request):
        bench.steps(1.0)
        if request.param is Request.START:
            bench.core.request(Request.RETURN_HOME)
            bench.steps(0.5)
            assert bench.core.mission.over
        assert bench.core.request(request.param)
        return bench

    def test_it_brakes_and_asks_until_the_new_run_comes(self, asked):
        for decision in asked.steps(3.0, near_sample=True):
            command = decision.command
            assert (command.throttle, command.brake, command.steering_angle) == (0.0, 1.0, 0.0)
            assert command.new_run
            assert not command.pickup
            assert decision.state is State.IDLE
        asked.begin_run()
        first = asked.step()
        assert first.state is State.FORWARD
        assert not first.command.new_run
        assert first.progress.elapsed == 0.0
        assert not any(decision.command.new_run for decision in asked.steps(1.0))

    def test_it_begins_one_mission(self, asked):
        number = asked.core.mission_number
        asked.step()
        asked.begin_run()
        asked.steps(1.0)
        assert asked.core.mission_number == number

    def test_a_time_limit_given_meanwhile_holds_for_the_new_run(self, asked):
        asked.core.limit_time(20.0)
        asked.step()
        asked.begin_run()
        asked.step()
        asked.time += 25.0
        asked.steps(1.0)
        assert asked.core.mission.over or asked.core.state is State.RETURN_HOME


def test_a_reset_before_the_first_frame_asks_for_nothing(bench):
    assert bench.core.request(Request.RESET)
    first = bench.step()
    assert first.state is State.FORWARD
    assert not first.command.new_run


def test_start_does_nothing_to_a_mission_that_goes_on(bench):
    bench.steps(1.0)
    number = bench.core.mission_number
    assert not bench.core.request(Request.START)
    assert not bench.step().command.new_run
    assert bench.core.mission_number == number


def test_goals_of_the_run_before_are_not_blacklisted(make_bench):
    bench = make_bench()
    bench.planner.plan = straight_plan(length=1.0)
    bench.steps(4.0)
    assert len(next_request(bench).blacklisted) > 0
    assert next_request(bench).last_goal.kind is GoalKind.FRONTIER
    bench.begin_run()
    bench.step()
    request = next_request(bench)
    assert len(request.blacklisted) == len(request.retryable) == 0
    assert request.last_goal is None
