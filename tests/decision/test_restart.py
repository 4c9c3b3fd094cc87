"""A decision that goes on with a run knows the mission that it had, above all its home."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from cores import CoreBench
from frames_by_hand import AWAY, CONFIG, nanoseconds
from maps import MIDDLE, UNKNOWN
from node_bench import NodeBench
from test_new_run import assert_same_request, eventful_run

from rover_common.geometry import Pose
from rover_common.saved_state import Memory
from rover_decision.missions.sample_return import memory_of, resume
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.node import DecisionNode
from rover_decision.types import Request

FAR = Pose(MIDDLE.x + 20.0, MIDDLE.y, 0.0)


@pytest.fixture
def again(make_bench):
    """A bench whose core goes on with the mission of another one, after a while [s]."""

    def make(bench: CoreBench, after: float = 2.0, memory: Memory | None = None) -> CoreBench:
        resumed = make_bench()
        resumed.run, resumed.time = bench.run, bench.time + after
        resume(resumed.core, CONFIG, bench.run, memory or memory_of(bench.core))
        return resumed

    return make


def request_at(bench: CoreBench):
    """What a plan would be made of at the newest frame."""
    frame = bench.core.mission._tick.frame
    return bench.core.mission.plan_request(frame)(UNKNOWN)


def test_an_eventful_mission_goes_on_with_all_that_it_knows(make_bench, again):
    bench = make_bench()
    eventful_run(bench)
    what = {"pose": FAR, "sample_count": 2}
    bench.steps(1.3, **what)  # a goal is observed without result
    resumed = again(bench, after=0.0)
    for _ in range(3):
        before, after = bench.step(**what), resumed.step(**what)
    assert after.progress == before.progress
    assert after.state is before.state is State.FORWARD
    one, other = request_at(bench), request_at(resumed)
    assert one.home == (MIDDLE.x, MIDDLE.y)
    assert len(one.trail) > 20
    assert min(len(one.blocked), len(one.blacklisted)) > 0
    # What was observed last may count once more.
    one, other = (
        dataclasses.replace(each, last_goal=None, blacklisted=np.unique(each.blacklisted, axis=0))
        for each in (one, other)
    )
    assert_same_request(one, other)


def test_what_is_remembered_is_a_copy(make_bench, again):
    bench = make_bench()
    bench.steps(1.0)
    memory = memory_of(bench.core)
    trail = memory[1]["breadcrumbs"].copy()
    for step in range(20):
        bench.step(pose=Pose(MIDDLE.x + 0.5 * step, MIDDLE.y, 0.0))
    resumed = again(bench, memory=memory)
    resumed.step(pose=MIDDLE)
    assert np.array_equal(request_at(resumed).trail, trail)


def test_it_drives_on_and_neither_holds_nor_counts_as_stuck(make_bench, again):
    bench = make_bench()
    bench.time = 500.0
    bench.steps(30.0)
    resumed = again(bench, after=20.0)
    states = {decision.state for decision in resumed.steps(3.0)}
    assert states == {State.FORWARD}
    assert resumed.step().command.throttle > 0
    assert resumed.step().progress.elapsed > 50.0


def test_a_sample_that_was_picked_up_meanwhile_counts(make_bench, again):
    bench = make_bench()
    bench.steps(1.0, sample_count=3)
    resumed = again(bench)
    assert resumed.step(sample_count=2).progress.samples_collected == 1
    assert resumed.step(sample_count=2).progress.samples_total == 3


class TestPhases:
    """Where the mission was in its chart."""

    def test_heading_home(self, make_bench, again):
        bench = make_bench()
        bench.step()
        bench.core.request(Request.RETURN_HOME)
        bench.step(pose=AWAY)
        resumed = again(bench)
        assert resumed.step(pose=AWAY).state is State.RETURN_HOME
        assert resumed.step(pose=MIDDLE).state is State.DONE

    def test_over(self, make_bench, again):
        bench = make_bench()
        bench.step()
        bench.core.request(Request.RETURN_HOME)
        bench.steps(0.5, pose=MIDDLE)
        assert bench.core.mission.over
        assert again(bench).step(pose=FAR).state is State.DONE

    @pytest.mark.parametrize("homeward", [False, True])
    def test_paused(self, make_bench, again, homeward):
        bench = make_bench()
        bench.step()
        if homeward:
            bench.core.request(Request.RETURN_HOME)
        bench.step(pose=FAR)
        bench.core.request(Request.PAUSE)
        bench.step(pose=FAR)
        resumed = again(bench)
        assert resumed.step(pose=FAR).state is State.PAUSED
        resumed.core.request(Request.RESUME)
        after = State.RETURN_HOME if homeward else State.FORWARD
        assert resumed.step(pose=FAR).state is after

    def test_a_pickup_in_progress_is_waited_for(self, make_bench, again):
        bench = make_bench()
        bench.step()
        bench.step(near_sample=True)
        bench.step(picking_up=True)
        assert bench.core.state is State.PICKUP
        resumed = again(bench)
        assert resumed.step(picking_up=True).state is State.PICKUP
        resumed.steps(1.0, picking_up=True)
        decision = resumed.step(sample_count=2)
        assert (decision.state, decision.progress.samples_collected) == (State.FORWARD, 1)


def test_a_time_limit_that_was_asked_for_stays_and_the_parameters_one_does_not(make_bench, again):
    bench = make_bench()
    bench.steps(1.0)
    assert memory_of(bench.core)[0]["mission"]["time_limit"] is None
    bench.core.limit_time(30.0)
    resumed = again(bench, after=40.0)
    resumed.steps(1.0, pose=FAR)
    assert resumed.core.state is State.RETURN_HOME


@pytest.mark.parametrize("explorer", ["classic_a", "classic_b"])
def test_a_classic_finds_home_along_the_trail_that_it_had(make_bench, explorer):
    config = DecisionConfig(explorer=explorer, way_home="breadcrumbs")
    bench, resumed = make_bench(config=config), make_bench(config=config)
    ahead = [Pose(MIDDLE.x + 0.5 * step, MIDDLE.y, 0.0) for step in range(30)]
    aside = [Pose(ahead[-1].x, MIDDLE.y + 0.5 * step, 1.57) for step in range(30)]
    for pose in ahead + aside:
        bench.step(pose=pose)
    resumed.time = bench.time
    resume(resumed.core, config, bench.run, memory_of(bench.core))
    for each in (bench, resumed):
        each.core.request(Request.RETURN_HOME)
    for _ in range(5):
        before, after = (each.step(pose=aside[-1]) for each in (bench, resumed))
        assert before.state is State.RETURN_HOME
        assert (after.state, after.command) == (before.state, before.command)
    assert before.command.steering_angle != 0.0


@pytest.mark.parametrize("spoil", ["values", "arrays", "number", "trail"])
def test_a_memory_that_is_none_changes_nothing(make_bench, spoil):
    bench, fresh = make_bench(), make_bench()
    bench.steps(1.0)
    values, arrays = memory_of(bench.core)
    if spoil == "values":
        del values["completion"]
    elif spoil == "arrays":
        arrays = {}
    elif spoil == "number":
        values["samples"]["total"] = "many"
    else:
        arrays["breadcrumbs"] = arrays["breadcrumbs"].ravel()
    mission = fresh.core.mission
    with pytest.raises((ValueError, TypeError, KeyError)):
        resume(fresh.core, CONFIG, bench.run, (values, arrays))
    assert fresh.core.mission is mission
    assert fresh.core.run is None


class TestNode:
    """One node after another, in the same run."""

    def again(self, bench: NodeBench) -> None:
        ros = bench.ros
        ros.end(bench.node)
        bench.node = ros.add(DecisionNode)
        for publisher in bench._parts.values():
            assert ros.spin_until(lambda p=publisher: p.get_subscription_count() > 0)
        assert ros.spin_until(lambda: bench.node.count_subscribers(bench.node._command.topic) > 0)

    def test_home_and_time_and_samples_stay(self, ros):
        bench = NodeBench(ros)
        bench.frame(pose=MIDDLE, sample_count=3)
        for _ in range(5):
            bench.frame(pose=FAR, sample_count=2)
        self.again(bench)
        bench.frame(pose=FAR, sample_count=2)
        assert ros.spin_until(lambda: bench.states[-1].elapsed > 5.5 * 0.3)
        report = bench.states[-1]
        assert report.home_distance == pytest.approx(20.0)
        assert (report.samples_collected, report.samples_total) == (1, 3)
        assert report.elapsed == pytest.approx(6 * 0.3)

    def test_a_new_run_begins_where_the_rover_stands(self, ros):
        bench = NodeBench(ros)
        bench.frame(pose=MIDDLE)
        bench.frame(pose=FAR)
        bench.begin_run()
        self.again(bench)
        bench.frame(pose=AWAY)
        assert ros.spin_until(lambda: bench.states[-1].home_distance == 0.0)
        assert bench.states[-1].elapsed == 0.0

    def test_while_it_waits_for_a_new_run_it_keeps_no_state_of_the_old_one(self, ros, tmp_path):
        bench = NodeBench(ros, state_dir=str(tmp_path))
        bench.frame(pose=MIDDLE)
        bench.call("reset")
        bench.frame(pose=FAR)
        ros.end(bench.node)
        bench.node = ros.add(DecisionNode, state_dir=str(tmp_path))
        for publisher in bench._parts.values():
            assert ros.spin_until(lambda p=publisher: p.get_subscription_count() > 0)
        bench.begin_run()
        bench.frame(pose=AWAY)
        assert bench.node._core.mission._parts.home == (AWAY.x, AWAY.y)
        assert nanoseconds(bench.time) >= bench.run.start
