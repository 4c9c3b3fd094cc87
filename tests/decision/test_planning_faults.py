"""Plans that are late, old, wrong or missing: the mission stands, goes on, or comes home."""

from __future__ import annotations

from functools import partial

import pytest
from cores import CoreBench
from frames_by_hand import AWAY, CONFIG, rock
from maps import MIDDLE, UNKNOWN

from rover_common.types import SAFE_COMMAND
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.states.hold import DEADLINE
from rover_decision.types import Decision, Request
from rover_navigation import plan_scheduler

MAX_AGE = CONFIG.plan_max_age


def drives(decision: Decision) -> bool:
    return decision.command.throttle > 0


def holds(decision: Decision) -> bool:
    """With the full brake, whatever the frame."""
    if decision.state is State.HOLD:
        assert decision.command == SAFE_COMMAND
    return decision.state is State.HOLD


def heads_home(decision: Decision) -> bool:
    return decision.state is State.RETURN_HOME


@pytest.fixture
def driving(bench) -> CoreBench:
    """A core whose rover drives along a plan."""
    bench.step_until(drives, 2.0)
    return bench


class TestPlannerThatRaises:
    @pytest.fixture
    def holding(self, driving):
        driving.planner.fails = True
        driving.step_until(holds, 2.0)
        return driving

    def test_the_rover_holds_until_the_next_good_plan(self, holding):
        failures = holding.core.plan_failures
        assert failures >= 1
        for decision in holding.steps(1.0):
            assert holds(decision)
            assert decision.reason == "holds: the planner failed"
        assert holding.core.plan_failures > failures  # it asks for plans on and on
        assert holding.core.last_failure.startswith("ZeroDivisionError: no such thing (")
        assert "cores.py:" in holding.core.last_failure
        holding.planner.fails = False
        assert holding.step_until(drives, 2.0).state is State.FORWARD
        failures = holding.core.plan_failures
        assert all(map(drives, holding.steps(1.0)))
        assert holding.core.plan_failures == failures

    def test_in_the_end_the_rover_comes_home_without_plans(self, holding):
        holding.place = AWAY
        holding.step_until(heads_home, DEADLINE + 1.0)
        coming = holding.step()
        assert coming.state is State.RETURN_HOME
        assert coming.command != SAFE_COMMAND
        holding.place = MIDDLE
        assert holding.step().state is State.DONE


def test_the_first_plan_may_fail(bench):
    bench.planner.fails = True
    bench.step_until(holds, 2.0)
    bench.planner.fails = False
    assert bench.step_until(drives, 2.0).state is State.FORWARD


def test_a_new_run_forgets_a_failure(bench):
    bench.planner.fails = True
    bench.step_until(holds, 2.0)
    bench.begin_run()
    bench.maps = False
    assert not any(map(holds, bench.steps(1.0, map_age=0.05)))


class TestStaleInputs:
    """Maps are due, or come, no longer."""

    def test_a_plan_too_old_holds(self, make_bench):
        bench = make_bench(lockstep=False)
        bench.step_until(drives, 2.0)
        bench.maps = False
        start = bench.time
        held = bench.step_until(holds, MAX_AGE + 1.0)
        assert bench.time - start == pytest.approx(MAX_AGE, abs=0.4)
        assert held.reason == "holds: the plan is too old"
        bench.maps = True
        assert bench.step_until(drives, 2.0).state is State.FORWARD

    def test_a_map_too_old_holds(self, make_bench):
        """Perception publishes none; plans do not age before their maps do."""
        bench = make_bench(lockstep=False)
        bench.steps(MAX_AGE + 1.0)
        old = bench.step(map_age=MAX_AGE + 0.1)
        assert holds(old)
        assert old.reason == "holds: the map is too old"
        assert bench.step_until(drives, 2.0).state is State.FORWARD

    def test_a_stale_plan_is_not_driven_along_on_the_path_home(self, make_bench):
        """The rover goes on by sight instead: a detour, but no stop."""
        bench = make_bench(lockstep=False)
        bench.step_until(drives, 2.0)
        bench.core.request(Request.RETURN_HOME)
        bench.place = AWAY
        bench.step()
        assert bench.core.mission.overlay().plan is not None
        bench.maps = False
        assert not any(map(holds, bench.steps(MAX_AGE + 1.0)))
        assert bench.core.mission.overlay().plan is None

    def test_a_hold_on_the_path_home_does_not_wait_for_plans(self, make_bench):
        bench = make_bench(lockstep=False)
        bench.step()
        bench.place = AWAY
        bench.core.request(Request.RETURN_HOME)
        bench.steps(0.5)
        bench.planner.fails = True
        bench.maps = False
        bench.time += 2 * MAX_AGE
        assert holds(bench.step())
        assert heads_home(bench.step())

    def test_a_rock_is_driven_to_by_sight_without_plans(self, driving):
        near = (rock(MIDDLE.x + 2.0, MIDDLE.y),)
        assert driving.step(rocks=near).state is State.ROCK_APPROACH
        driving.planner.fails = True
        assert not any(map(holds, driving.steps(1.0, rocks=near)))


class TestPlannerThatHangs:
    def test_a_live_rover_holds_and_comes_home_by_sight(self, make_bench):
        bench = make_bench(lockstep=False)
        bench.step_until(drives, 2.0)
        bench.planner.gate.clear()
        bench.place = AWAY
        bench.step_until(holds, MAX_AGE + 1.0)
        held = bench.time
        coming = bench.step_until(heads_home, 2 * DEADLINE)
        assert bench.time - held == pytest.approx(DEADLINE, abs=0.3)
        assert coming.command != SAFE_COMMAND
        bench.place = MIDDLE
        assert bench.step().state is State.DONE

    def test_lockstep_gives_it_up_and_goes_on_with_another_thread(self, make_bench, monkeypatch):
        patient = partial(plan_scheduler.PlanScheduler, patience=0.5)
        monkeypatch.setattr("rover_decision.core.PlanScheduler", patient)
        bench = make_bench()
        bench.step_until(drives, 2.0)
        bench.planner.hangs = 1
        bench.planner.gate.clear()
        bench.step_until(holds, 1.0)
        assert bench.core.plan_failures == 1
        assert "no plan within 0.5 s" in bench.core.last_failure
        assert bench.step_until(drives, 2.0).state is State.FORWARD
        assert bench.core.plan_failures == 1

    def test_a_live_planner_that_is_late_is_used_until_its_plans_are_too_old(self, make_bench):
        bench = make_bench(lockstep=False)
        bench.step_until(drives, 2.0)
        bench.planner.gate.clear()
        late = bench.time
        bench.steps(0.9 * MAX_AGE)
        assert bench.core.state is not State.HOLD
        bench.planner.gate.set()
        bench.steps(0.5)
        newest = bench.core.mission.overlay().plan.stamp * 1e-9
        assert newest > late + 0.8 * MAX_AGE
        assert len(bench.planner.requests) < 20  # most of them were overtaken


class TestMapThatNeverComes:
    def test_a_live_rover_holds_and_comes_home_by_sight(self, make_bench):
        bench = make_bench(lockstep=False)
        bench.maps = False
        bench.step()
        bench.place = AWAY
        bench.step_until(holds, MAX_AGE + 1.0)
        bench.step_until(heads_home, DEADLINE + 1.0)
        bench.place = MIDDLE
        assert bench.step().state is State.DONE

    def test_lockstep_waits_until_it_is_told_to_stop(self, make_bench):
        bench = make_bench()
        bench.maps = False
        bench.step()
        waits = bench.time + CONFIG.plan_delay
        assert not bench.core.ready(round(waits * 1e9))
        bench.core.stop_waiting()
        assert bench.core.ready(round(waits * 1e9))
        held = bench.step(map_age=0.05)
        assert holds(held)
        assert bench.core.plan_failures == 1
        assert "map" in bench.core.last_failure
        bench.maps = True
        assert bench.step_until(drives, 2.0).state is State.FORWARD

    def test_frames_without_their_maps_are_decided_with_older_plans(self, driving):
        driving.maps = False
        assert all(map(drives, driving.steps(0.9 * MAX_AGE)))
        newer = round(driving.time * 1e9)
        driving.core.give_map(newer, UNKNOWN)  # serves the orders that wait as well
        assert driving.core.ready(newer)
