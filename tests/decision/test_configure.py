"""Parameters that change during a mission: they count from the next frame on, memory stays."""

from __future__ import annotations

from functools import partial

from cores import HandPlanner
from frames_by_hand import AWAY, CONFIG, exploring, nanoseconds
from maps import straight_plan

from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.mission import SampleReturnMission
from rover_decision.types import Request

SLOW = DecisionConfig(top_speed=0.5)
CLASSIC = DecisionConfig(explorer="classic_b")


def test_another_top_speed_counts_at_once():
    mission = exploring()
    assert mission.tick(speed=1.0).command.throttle > 0
    mission.mission.configure(SLOW)
    assert mission.tick(speed=1.0).command.throttle <= 0
    mission.mission.configure(CONFIG)
    assert mission.tick(speed=1.0).command.throttle > 0


def test_another_way_home_is_taken_while_it_drives_home():
    mission = exploring()
    mission.mission.request(Request.RETURN_HOME)
    assert "by breadcrumbs" in mission.tick(pose=AWAY).reason
    mission.mission.configure(DecisionConfig(way_home="bearing"))
    assert "by bearing" in mission.tick(pose=AWAY).reason


def test_the_same_way_home_goes_on_where_it_was():
    mission = exploring()
    paths = mission.mission._parts.home_paths
    paths.got_stuck()
    paths.got_stuck()
    assert paths.method.name == "shortest_path"
    mission.mission.configure(SLOW)
    mission.tick()
    assert paths.method.name == "shortest_path"


def test_what_the_mission_remembers_stays():
    mission = exploring()
    mission.ticks(2.0)
    before = mission.tick().progress
    parts = mission.mission._parts
    dropped = len(parts.breadcrumbs.points)
    mission.mission.configure(CLASSIC)
    after = mission.tick().progress
    assert after.elapsed > before.elapsed
    assert after.recoveries == before.recoveries
    assert mission.mission._parts is parts
    assert len(parts.breadcrumbs.points) >= dropped > 0


def test_a_new_mission_begins_with_the_parameters_and_planner_in_force(make_bench):
    bench, other = make_bench(), HandPlanner(straight_plan())
    bench.steps(1.0)
    bench.core.configure(CLASSIC, partial(SampleReturnMission, CLASSIC), other)
    bench.begin_run()
    reasons = {decision.reason for decision in bench.steps(1.0)}
    assert "follows the wall" in reasons
    assert not any(reason.startswith("drives to") for reason in reasons)
    assert other.requests
    assert all(request.stamp > nanoseconds(1.9) for request in other.requests)
