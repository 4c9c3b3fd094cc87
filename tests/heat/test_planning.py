"""What a plan says to do next."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from looks import look
from made_fixes import cloud
from mapped_rooms import map_of
from warm_room import Room, box

from rover_common.geometry import Pose, wrap_angle
from rover_common.types import GridMap
from rover_heat.config import HeatConfig
from rover_heat.planning.planner import HeatPlanner
from rover_heat.planning.types import GoalKind, HeatPlan, HeatPlanRequest
from rover_heat.ramp.estimate import Ramp
from rover_heat.ramp.hazards import NO_HAZARDS
from rover_heat.thermal.coverage import Coverage

CONFIG = HeatConfig()
FAST = replace(CONFIG, fast_explore=True)
# two rooms of 1.5 m with a door of 0.6 m between them
ROOMS = Room(np.vstack([box(3.0, 1.5), [[1.5, 0.0, 1.5, 0.45], [1.5, 1.05, 1.5, 1.5]]]))
WEST, EAST = (0.4, 0.25), (2.2, 0.75)
STRIP = Room(box(1.02, 3.28))


def plan(seen_from, config=CONFIG, room=ROOMS, pose=None, **what) -> HeatPlan:
    pose = pose or Pose(*seen_from[0], 0.0)
    return HeatPlanner(config).plan(HeatPlanRequest(0, map_of(room, seen_from), pose, **what))


def test_a_frontier_is_looked_at_from_known_ground_that_sees_it():
    found = plan([WEST], FAST)
    assert len(found.frontiers) > 0
    for goal in found.goals:
        assert goal.kind is GoalKind.FRONTIER
        assert 0.15 < goal.pose.x < 2.85
        bearing = math.atan2(goal.y - goal.pose.y, goal.x - goal.pose.x)
        assert abs(wrap_angle(bearing - goal.pose.yaw)) < 1e-6
        assert math.dist((goal.x, goal.y), (goal.pose.x, goal.pose.y)) <= 1.0
        assert math.isfinite(goal.seconds)
    assert found.goals[0].seconds == min(goal.seconds for goal in found.goals)


def test_when_all_is_mapped_no_frontier_is_left():
    assert plan([WEST, EAST, (0.75, 1.3), (2.8, 1.4)], FAST).goals == ()


def test_a_frontier_behind_a_wall_is_no_goal():
    closed = Room(np.vstack([box(3.0, 1.5), [[1.5, 0.0, 1.5, 1.5]]]))
    grid = map_of(closed, [WEST, EAST])
    grid.cells[10:20, 60:68] = -1  # unknown in the other room
    found = HeatPlanner(FAST).plan(HeatPlanRequest(0, grid, Pose(*WEST, 0.0)))
    assert len(found.frontiers) > 0
    assert found.goals == ()


def test_known_frontiers_are_left_out_and_failed_ones_wait():
    found = plan([WEST], FAST)
    first = found.goals[0]
    known = np.array([(first.x, first.y, 5.0)])
    assert plan([WEST], FAST, known=known).goals == ()
    failed = np.array([(first.x, first.y, 0.2)])
    waits = plan([WEST], FAST, failed=failed)
    assert first not in waits.goals
    assert waits.waiting[0] == first


def test_around_the_robot_there_is_no_frontier():
    cells = np.full((60, 60), -1, np.int8)
    cells[28:32, 28:32] = 0
    grid = GridMap(0.05, -1.5, -1.5, cells)
    found = HeatPlanner(FAST).plan(HeatPlanRequest(0, grid, Pose(0.0, 0.0, 0.0)))
    assert all(math.hypot(x, y) > 0.15 for x, y in found.frontiers)


def test_ground_at_the_edge_of_the_map_is_a_frontier():
    cells = np.zeros((40, 40), np.int8)
    cells[0], cells[:, 0], cells[-1] = 100, 100, 100  # the east is open
    found = HeatPlanner(FAST).plan(
        HeatPlanRequest(0, GridMap(0.05, 0.0, 0.0, cells), Pose(1, 1, 0))
    )
    (goal,) = found.goals
    assert goal.x > 1.9


def test_views_examine_all_faces_in_the_end():
    places = [WEST, EAST, (0.75, 1.3), (2.8, 1.4)]
    coverage, pose = Coverage(CONFIG), Pose(*WEST, 0.0)
    number, explored = 0, []
    for _ in range(60):
        found = plan(places, pose=pose, examined=coverage.snapshot())
        explored.append(found.explored)
        if not found.goals:
            break
        goal = found.goals[0]
        assert goal.kind is GoalKind.VIEW
        assert len(goal.faces) >= 3
        pose = goal.pose
        for sensor in (1, 2):
            look(coverage, pose, ROOMS, (number, number + 1), sensor)
        number += 3
    assert found.goals == ()
    assert explored == sorted(explored)
    assert explored[0] == 0.0
    assert explored[-1] > 0.95
    assert len(explored) < 30


def test_a_place_that_was_warm_too_seldom_is_viewed_again():
    places = [WEST, EAST, (0.75, 1.3), (2.8, 1.4)]
    coverage, pose = Coverage(CONFIG), Pose(0.75, 0.9, math.pi / 2)
    look(coverage, pose, ROOMS)
    few = tuple(cloud(0.75, 1.5, 2, normal=-math.pi / 2))
    enough = tuple(cloud(0.75, 1.5, 3, normal=-math.pi / 2))
    for fixes, open_again in (((), False), (few, True), (enough, False)):
        found = plan(places, examined=coverage.snapshot(), fixes=fixes)
        away = np.hypot(*(found.open_faces - (0.75, 1.475)).T)
        assert (away.min() < 0.05) == open_again
        assert len(found.suspects) == (2 if open_again else 0)


@pytest.mark.parametrize("sensors", [(1,), (2,)])
def test_a_view_is_for_the_sensors_that_are_alive(sensors):
    found = plan([WEST, EAST], sensors=sensors)
    for goal in found.goals:
        axis = goal.pose.yaw + (CONFIG.thermal_yaw_1 if sensors == (1,) else 0.0)
        bearings = np.arctan2(goal.faces[:, 1] - goal.pose.y, goal.faces[:, 0] - goal.pose.x)
        assert np.abs(np.angle(np.exp(1j * (bearings - axis)))).max() < math.radians(22.5)
    assert plan([WEST, EAST, (0.75, 1.3), (2.8, 1.4)], sensors=()).goals == ()


def test_a_stand_off_faces_the_source_from_its_warm_side():
    fixes = tuple(cloud(0.75, 1.5, 6, normal=-math.pi / 2))
    found = plan([WEST, EAST], fixes=fixes)
    (source,), (stands,) = found.sources, found.stand_offs
    pose = stands[0].pose
    assert math.dist((pose.x, pose.y), (source.x, source.y)) == pytest.approx(0.30, abs=1e-6)
    assert abs(wrap_angle(pose.yaw - math.pi / 2)) < 0.01
    assert all(math.isfinite(stand.seconds) for stand in stands)
    aside = {round(math.degrees(wrap_angle(stand.pose.yaw - pose.yaw))) for stand in stands}
    assert aside == {0, 20, -20}


def test_without_room_at_the_stand_off_there_is_another_or_none():
    near_corner = plan([WEST, EAST], fixes=tuple(cloud(0.12, 1.5, 6, normal=-math.pi / 2)))
    assert all(stand.pose.x > 0.12 for stand in near_corner.stand_offs[0])
    outside = plan([WEST, EAST], fixes=tuple(cloud(0.75, 1.5, 6, normal=math.pi / 2)))
    assert outside.stand_offs == ((),)


def test_a_stand_off_on_the_ramp_is_none():
    ramp = Ramp(0.51, 1.5, math.pi / 2, straight=True)
    fixes = tuple(cloud(0.51, 3.28, 6, normal=-math.pi / 2))
    seen = [(0.5, 0.5), (0.5, 2.5)]
    assert len(plan(seen, room=STRIP, fixes=fixes).stand_offs[0]) > 0
    hazards = NO_HAZARDS.with_ramp(ramp, 1.25)
    found = plan(seen, room=STRIP, fixes=fixes, hazards=hazards, ramps=(ramp,))
    assert found.stand_offs == ((),)
    (approach,) = found.approaches
    assert ramp.along_and_across(approach.pose.x, approach.pose.y)[0] == pytest.approx(-0.5)
    assert math.isfinite(approach.seconds)


def test_an_approach_out_of_reach_is_said_to_be():
    ramp = Ramp(5.0, 5.0, 0.0, straight=True)
    (approach,) = plan([WEST], ramps=(ramp,)).approaches
    assert math.isinf(approach.seconds)


def test_the_ramp_is_sought_on_ground_not_driven_on_the_widest_first():
    lane = [[1.02, 0.4, 1.02, 3.28], [1.63, 0.0, 1.63, 3.28]]
    outline = [[0.0, 0.0, 1.63, 0.0], [0.0, 0.0, 0.0, 3.28], [0.0, 3.28, 1.63, 3.28]]
    room = Room(np.array([*outline, *lane]))
    trail = np.stack([np.full(50, 0.5), np.linspace(0.2, 1.2, 50)], axis=1)
    found = plan([(0.5, 0.5), (1.3, 0.2), (1.3, 3.0), (0.5, 3.0)], room=room, trail=trail,
                 seek_ramp=True)  # fmt: skip
    assert {goal.kind for goal in found.goals} == {GoalKind.GROUND}
    assert found.goals[0].pose.x < 1.02
    assert found.goals[0].pose.y > 1.2
    for goal in found.goals:
        assert np.hypot(*(trail - (goal.x, goal.y)).T).min() > 0.3


def test_a_robot_on_unknown_ground_gets_no_plan():
    cells = np.full((60, 60), 100, np.int8)
    grid = GridMap(0.05, 0.0, 0.0, cells)
    found = HeatPlanner(CONFIG).plan(HeatPlanRequest(0, grid, Pose(1.0, 1.0, 0.0)))
    assert not found.placed
    assert found.goals == ()
    assert math.isnan(found.explored)


def test_the_same_request_gives_the_same_plan():
    request = HeatPlanRequest(0, map_of(ROOMS, [WEST]), Pose(*WEST, 0.0))
    first, second = HeatPlanner(CONFIG).plan(request), HeatPlanner(CONFIG).plan(request)
    assert [g.pose for g in first.goals] == [g.pose for g in second.goals]
