"""What the classic solutions share: counting, breadcrumbs, completion, and to be switched to."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest
from classic_frames import AWAY, ClassicMission, driving, ground, nav, rock_at
from frames_by_hand import PLAN, exploring, frame
from maps import MIDDLE, UNKNOWN, request, straight_plan

from rover_common.geometry import Pose
from rover_common.ground_truth import TruthError
from rover_common.types import GridMap
from rover_decision.missions.sample_return import make_planner
from rover_decision.missions.sample_return.chart import Event, State, transitions
from rover_decision.missions.sample_return.classic.backtrack import FRAMES, BreadcrumbTrail
from rover_decision.missions.sample_return.classic.chart_a import ClassicAChart
from rover_decision.missions.sample_return.classic.chart_b import ClassicBChart
from rover_decision.missions.sample_return.classic.ground import Ground
from rover_decision.missions.sample_return.completion import Trigger
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Request

CLASSICS = ("classic_a", "classic_b")
FAR = straight_plan(pose=AWAY)


def trail(*places: tuple[float, float]) -> BreadcrumbTrail:
    """Of a rover that stayed at each place until a breadcrumb was dropped."""
    made = BreadcrumbTrail()
    for x, y in places:
        for _ in range(FRAMES):
            made.add(Pose(x, y, 0.0))
    return made


class TestGround:
    def test_cells_are_those_of_the_documents(self):
        coarse = Ground.of(nav(), 0.25)
        assert coarse.cells == pytest.approx(6.25 * len(coarse.ranges))
        assert Ground.of(nav(), 0.1).cells == len(nav().ranges)

    def test_the_near_part(self):
        near = ground().within(2.0)
        assert near.ranges.max() < 2.0
        assert 0 < near.cells < ground().cells


class TestBreadcrumbs:
    def test_one_every_twelve_frames_and_a_metre_apart(self):
        made = BreadcrumbTrail()
        for step in range(2 * FRAMES + 1):
            made.add(Pose(10.0 + step / 2, 5.7, 0.0))
        assert made.next == (22.0, 5.7)
        made.follow(Pose(21.8, 5.0, 0.0))
        assert made.next == (16.0, 5.7)
        assert trail((0, 0), (0.9, 0), (5, 0), (5.5, 0)).next == (5, 0)

    def test_reversed_and_each_within_two_metres(self):
        made = trail((0, 0), (5, 0), (10, 0))
        made.follow(Pose(12.1, 0.0, 0.0))
        assert made.next == (10, 0)
        made.follow(Pose(11.9, 0.0, 0.0))
        assert made.next == (5, 0)
        made.follow(Pose(5.0, 1.0, 0.0))
        made.follow(Pose(0.0, 0.0, 0.0))
        assert made.next == (0, 0)

    @pytest.mark.parametrize(("aside", "next_place"), [(2.9, (5, 0)), (3.1, (10, 3.1))])
    def test_loops_are_cut_out(self, aside, next_place):
        """A dead end, driven into and out of along its other wall."""
        into = [(x, 0) for x in range(0, 21, 5)]
        made = trail(*into, *((x, aside) for x in range(20, 4, -5)))
        made.follow(Pose(5.0, aside, 0.0))
        assert made.next == next_place


class TestCompletion:
    @pytest.mark.parametrize(
        ("share", "all_of_it", "collected", "explored", "reached"),
        [
            (0.0, False, True, 0.0, True),
            (0.0, False, False, 1.0, False),
            (0.9, False, True, 0.1, True),
            (0.9, False, False, 0.9, True),
            (0.9, False, False, 0.89, False),
            (0.9, True, True, 0.89, False),
            (0.9, True, False, 0.9, False),
            (0.9, True, True, 0.9, True),
        ],
    )
    def test_samples_or_and_the_share(self, share, all_of_it, collected, explored, reached):
        assert Trigger(share, all_of_it).reached(collected, explored) == reached

    @pytest.mark.parametrize("explorer", CLASSICS)
    def test_a_classic_obeys_the_rule(self, explorer):
        half = {"complete_at": 0.5, "complete_rule": "all"}
        assert driving(explorer, **half).tick(plan=FAR).state is State.FORWARD
        done = driving(explorer, **half).tick(plan=FAR, sample_count=0)
        assert done.state is State.RETURN_HOME

    def test_so_does_an_explorer_that_plans(self):
        far = Pose(MIDDLE.x + 2.5, MIDDLE.y, 0.0)
        config = DecisionConfig(complete_at=PLAN.explored)
        assert exploring().tick(pose=far).state is State.FORWARD
        mission = exploring(DecisionConfig(complete_at=1.0))
        assert mission.tick(pose=far).state is State.FORWARD
        assert exploring(replace(config)).tick(pose=far).state is State.RETURN_HOME

    def test_a_truth_takes_the_place_of_the_maps_own_borders(self, tmp_path):
        truth = np.zeros((200, 200), np.uint8)
        truth[15:25, 10:30] = 255  # of these 20 m the hall has 10
        cv2.imwrite(str(tmp_path / "map.png"), truth)
        cells = np.full((800, 800), -1, np.int8)
        cells[60:100, 40:80] = 0
        asked = request(GridMap(0.25, 0.0, 0.0, cells))
        config = DecisionConfig(truth=str(tmp_path / "map.png"))
        assert make_planner(config).plan(asked).explored == 0.5
        assert make_planner(DecisionConfig()).plan(asked).explored != 0.5
        with pytest.raises(TruthError):
            make_planner(DecisionConfig(truth=str(tmp_path / "none.png")))

    @pytest.mark.parametrize("explorer", CLASSICS)
    def test_the_time_limit_leads_home(self, explorer):
        mission = driving(explorer, time_limit=10.0)
        states = {made.state for made in mission.ticks(12.0, moves=0.1)}
        assert State.RETURN_HOME in states


class TestCharts:
    @pytest.mark.parametrize("chart", [ClassicAChart, ClassicBChart])
    def test_every_state_but_tilt_and_hold_is_reached_and_left(self, chart):
        arrows = transitions(chart)
        states = set(State) - {State.TILT, State.HOLD}
        assert {arrow.target for arrow in arrows} | {State.IDLE} == states
        assert {arrow.source for arrow in arrows} | {State.DONE} == states

    @pytest.mark.parametrize("chart", [ClassicAChart, ClassicBChart])
    def test_only_home_ends_it(self, chart):
        ends = {(a.source, a.event) for a in transitions(chart) if a.target is State.DONE}
        assert ends == {(State.RETURN_HOME, Event.arrived)}

    @pytest.mark.parametrize("explorer", CLASSICS)
    def test_a_pause_holds_and_returns_to_the_phase(self, explorer):
        mission = driving(explorer)
        assert mission.request(Request.PAUSE)
        assert mission.tick().command.brake > 0
        assert mission.request(Request.RESUME)
        assert mission.tick().state is State.FORWARD
        mission.request(Request.RETURN_HOME)
        mission.tick()
        mission.request(Request.PAUSE)
        mission.request(Request.RESUME)
        assert mission.tick().state is State.RETURN_HOME

    @pytest.mark.parametrize(("explorer", "planned"), [("classic_a", False), ("frontier", True)])
    def test_only_those_that_plan_have_plans_search_the_trail_for_a_path_home(
        self, explorer, planned
    ):
        mission = ClassicMission(explorer, way_home="breadcrumbs")
        mission.tick()
        mission.request(Request.RETURN_HOME)
        mission.tick()
        shown = frame(mission.time)
        assert mission.mission.plan_request(shown)(UNKNOWN).home_by_breadcrumbs is planned

    @pytest.mark.parametrize("explorer", CLASSICS)
    def test_called_home_it_leaves_the_rocks(self, explorer):
        mission = driving(explorer)
        mission.request(Request.RETURN_HOME)
        assert mission.tick(rock=rock_at((4.0, 0.0))).state is State.RETURN_HOME


class TestSwitching:
    @pytest.mark.parametrize("explorer", CLASSICS)
    def test_a_classic_takes_over_from_a_plan_and_gives_back(self, explorer):
        mission = exploring()
        mission.mission.configure(DecisionConfig(explorer=explorer))
        assert mission.tick(plan=None).reason == "follows the wall"
        mission.mission.configure(DecisionConfig())
        assert mission.tick().reason.startswith("drives to")

    def test_what_is_remembered_stays(self):
        mission = driving("classic_b")
        before = mission.tick().progress
        mission.mission.configure(DecisionConfig(explorer="classic_a", nav_cell=0.1))
        after = mission.tick().progress
        assert after.elapsed > before.elapsed
        assert after.home_distance == pytest.approx(before.home_distance, abs=0.2)

    @pytest.mark.parametrize(
        ("requests", "state"),
        [
            ((Request.RETURN_HOME,), State.RETURN_HOME),
            ((Request.PAUSE,), State.PAUSED),
            ((Request.RETURN_HOME, Request.PAUSE), State.PAUSED),
        ],
    )
    def test_it_goes_on_in_the_phase_at_hand(self, requests, state):
        mission = driving("classic_a")
        for asked in requests:
            mission.request(asked)
        mission.tick()
        mission.mission.configure(DecisionConfig(explorer="classic_b"))
        assert mission.tick().state is state
        if state is State.PAUSED:
            mission.request(Request.RESUME)
            homeward = Request.RETURN_HOME in requests
            assert mission.tick().state is (State.RETURN_HOME if homeward else State.FORWARD)

    def test_an_arm_at_work_is_waited_for(self):
        mission = driving("classic_a")
        mission.tick(near_sample=True)
        mission.mission.configure(DecisionConfig(explorer="classic_b"))
        mission.tick(near_sample=True, picking_up=True)
        assert mission.state is State.PICKUP
        assert mission.tick(sample_count=2).state is State.FORWARD

    def test_one_that_has_not_begun_begins_with_it(self):
        mission = ClassicMission("tour")
        mission.mission.configure(DecisionConfig(explorer="classic_a", nav_cell=0.1))
        assert mission.tick().reason == "follows the wall"


@pytest.mark.parametrize("explorer", CLASSICS)
@pytest.mark.parametrize("way_home", ["breadcrumbs", "shortest_path", "bearing"])
def test_each_way_home_is_named_and_driven(explorer, way_home):
    mission = driving(explorer, way_home=way_home)
    mission.request(Request.RETURN_HOME)
    home = replace(FAR, home_path=straight_plan(pose=Pose(AWAY.x, AWAY.y, 0.1)).path)
    decision = mission.tick(lambda x, y: np.abs(y) < 1.5, plan=home, pose=AWAY)
    assert decision.reason == f"goes home by {way_home}"
    if way_home == "shortest_path":
        assert decision.command.steering_angle == pytest.approx(0.1, abs=0.05)
