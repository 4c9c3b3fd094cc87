"""The figures by which a heat mission is accepted, each by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from heat_runs import (
    MAZE,
    NORTH,
    ON_RAMP,
    ON_TOP,
    SERVED,
    START,
    TRUTH,
    launch,
    map_of,
    reported,
    result_of,
    run_of,
    ticks_of,
)

from rover_common.geometry import Pose
from rover_heat.mission.chart import State
from rover_tools.evaluation.heat_mission_result import HEAT_RESULT_KEYS, failed_heat_result
from rover_tools.evaluation.heat_score import (
    early_ascent,
    explored,
    pose_rmse,
    score_launches,
    score_sources,
    score_walls,
    stop_seconds,
)


def points(*xy: tuple[float, float]) -> np.ndarray:
    return np.array(xy, float).reshape(-1, 2)


# Sources


@pytest.mark.parametrize(
    ("places", "found", "false", "error"),
    [
        (points((0.0, 2.0), (3.0, 4.0)), 2, 0, 0.0),
        (points((0.0, 2.14), (3.0, 4.0)), 2, 0, 0.14),
        (points((0.0, 2.16), (3.0, 4.0)), 1, 1, 0.16),
        (points((0.0, 2.0), (0.0, 2.1), (3.0, 4.0)), 2, 1, 0.0),  # one source, one entry
        (points((0.0, 2.0)), 1, 0, math.hypot(3.0, 2.0)),
        (points(), 0, 0, None),
    ],
)
def test_sources_are_matched_one_to_one_within_their_distance(places, found, false, error):
    score = score_sources(MAZE, places)
    assert (score.found, score.false) == (found, false)
    assert score.error_max == (None if error is None else pytest.approx(error))


def test_a_maze_without_sources_has_none_to_find():
    score = score_sources(replace(MAZE, sources=()), points((1.0, 1.0)))
    assert (score.found, score.false, score.error_max) == (0, 1, None)


# Launches


def beside(aside: float, distance: float) -> Pose:
    """Facing the source at (0, 2), so far [m] from it and so many degrees off its normal."""
    angle = math.radians(aside)
    return Pose(distance * math.cos(angle), 2.0 + distance * math.sin(angle), angle + math.pi)


def test_each_source_is_served_from_where_it_belongs():
    score = score_launches(MAZE, (SERVED, ON_RAMP), 0.30)
    assert (score.delivered, score.wrong, score.on_ramp) == (2, 0, True)
    assert score.error_max == pytest.approx(0.0)
    assert score.angle_max == pytest.approx(0.0)
    assert score.moving == 0


@pytest.mark.parametrize(
    "bad",
    [
        launch(beside(50.0, 0.30)),  # too far off the wall's normal
        launch(Pose(0.48, 2.0, math.pi)),  # too far from the wall
        launch(Pose(-0.30, 2.0, 0.0)),  # on the wrong side of the wall
        launch(Pose(0.30, 2.0, math.pi - math.radians(11.0))),  # facing aside
        launch(Pose(0.30, 2.0, math.pi), speed=0.02),  # driving
        launch(Pose(0.30, 2.0, math.pi), turn_rate=0.05),  # turning
    ],
)
def test_a_launch_that_does_not_serve_is_wrong(bad):
    score = score_launches(MAZE, (bad, ON_RAMP), 0.30)
    assert (score.delivered, score.wrong) == (1, 1)


def test_a_launch_within_the_tolerances_serves():
    near = launch(Pose(0.46, 2.0, math.pi + math.radians(9.0)))
    assert score_launches(MAZE, (near,), 0.30).delivered == 1
    assert score_launches(MAZE, (near,), 0.30).error_max == pytest.approx(0.11)
    assert math.degrees(score_launches(MAZE, (near,), 0.30).angle_max) == pytest.approx(9.0)
    assert score_launches(MAZE, (near,), 0.60).delivered == 0  # where it is to stand is a parameter


@pytest.mark.parametrize(("aside", "distance"), [(20.0, 0.30), (-20.0, 0.35), (0.0, 0.35)])
def test_a_launch_from_another_stand_off_pose_serves(aside, distance):
    score = score_launches(MAZE, (launch(beside(aside, distance)),), 0.30)
    assert (score.delivered, score.error_max) == (1, pytest.approx(0.0, abs=1e-9))


def test_a_second_launch_for_a_source_is_wrong():
    again = score_launches(MAZE, (SERVED, SERVED), 0.30)
    assert (again.delivered, again.wrong) == (1, 1)


def test_a_source_at_the_ramp_is_served_from_the_ramp_alone():
    before = launch(Pose(3.0, 3.7, NORTH))  # 0.30 m before it, on the descent
    score = score_launches(MAZE, (before,), 0.30)
    assert (score.delivered, score.wrong, score.on_ramp) == (0, 1, False)
    driving = score_launches(MAZE, (launch(ON_TOP, speed=0.1),), 0.30)
    assert (driving.on_ramp, driving.moving) == (False, 1)


def test_without_a_source_at_it_the_ramp_delivers_to_none():
    score = score_launches(replace(MAZE, sources=MAZE.sources[:1]), (SERVED, ON_RAMP), 0.30)
    assert (score.delivered, score.wrong, score.on_ramp) == (1, 0, True)


# Over time


def test_an_early_ascent_is_one_before_the_ramp_was_attempted():
    ticks = ticks_of((State.EXPLORING, 1.0), (State.ATTEMPTING_RAMP, 1.0))
    beyond = np.zeros(20)
    beyond[4], beyond[15] = 0.08, 0.6
    assert early_ascent(replace(ticks, beyond_foot=beyond)) == pytest.approx(0.08)
    never = ticks_of((State.EXPLORING, 2.0))
    assert early_ascent(replace(never, beyond_foot=beyond)) == pytest.approx(0.6)


def test_the_longest_stop_after_an_interrupt_counts():
    states = [(State.EXPLORING, 1.0), (State.TILT_INTERRUPT, 1.0)] * 2
    ticks, speed = ticks_of(*states), np.full(40, 0.2)
    speed[11:], speed[20:] = 0.0, 0.2
    speed[33:] = -0.005  # slow enough
    assert stop_seconds(replace(ticks, speed=speed)) == pytest.approx(0.3)
    speed[30:] = 0.2  # never again: until the end
    assert stop_seconds(replace(ticks, speed=speed)) == pytest.approx(0.9)
    assert stop_seconds(ticks_of((State.EXPLORING, 1.0))) is None


def test_the_pose_error_is_counted_once_a_second():
    ticks = ticks_of((State.EXPLORING, 4.0))
    estimated = ticks.true.copy()
    estimated[10] += (0.03, 0.04, 9.0)
    estimated[11:20] += 1.0  # between two seconds
    estimated[30] = math.nan  # no pose then
    error = pose_rmse(replace(ticks, estimated=estimated))
    assert error == pytest.approx(math.sqrt(0.05**2 / 3))
    assert pose_rmse(replace(ticks, estimated=np.full((40, 3), math.nan))) is None


def test_explored_is_what_it_was_when_exploring_ended():
    ticks = ticks_of((State.EXPLORING, 1.0), (State.ATTEMPTING_RAMP, 1.0))
    share = np.concatenate([np.linspace(0.1, 0.98, 10), np.zeros(10)])
    assert explored(replace(ticks, explored=share)) == pytest.approx(98.0)
    assert explored(ticks_of((State.FAILED, 1.0))) is None


# The map


def test_walls_are_right_where_they_are_and_mapped_where_they_are_seen():
    cells = np.zeros((60, 20))  # from START, which looks north: rows go west, columns north
    cells[19, :] = 100  # x from 0.00 to 0.05: the west wall, from y = 1 to 2
    cells[0, :5] = 100  # a quarter as many in the middle of the room
    cells[40:, :] = -1
    score = score_walls(MAZE, map_of(cells), START)
    assert score.right == pytest.approx(80.0)
    assert score.mapped == pytest.approx(100.0 * 1.0 / 16.0, abs=0.7)  # 1 m of 16 m
    nothing = score_walls(MAZE, map_of(np.zeros((3, 3))), START)
    assert (nothing.right, nothing.mapped) == (None, None)
    assert score_walls(MAZE, None, START).right is None


# Success


def test_a_mission_that_achieves_everything_is_a_success():
    result = result_of()
    assert result["success"]
    assert tuple(result) == HEAT_RESULT_KEYS == tuple(failed_heat_result("room-1", 1, "heat", "x"))
    assert (result["launch_angle_max"], result["launches_moving"]) == (0.0, 0)
    assert (result["time"], result["delivered"], result["sources_found"]) == (250.0, 2, 2)


@pytest.mark.parametrize(
    "changes",
    [
        {"sources": (reported(0.0, 2.0),)},
        {"sources": (reported(0.0, 2.2), reported(3.0, 4.0))},
        {"sources": (reported(0.0, 2.0), reported(3.0, 4.0), reported(2.0, 0.0))},
        {"truth": replace(TRUTH, launches=(ON_RAMP,))},
        {"truth": replace(TRUTH, launches=(SERVED,))},
        {"truth": replace(TRUTH, contacts=1)},
        {"truth": replace(TRUTH, ramp_contacts=1)},
        {"state": State.FAILED},
        {"state": State.EXPLORING},
        {"time_limit": 250.0},
    ],
)
def test_one_thing_missing_is_no_success(changes):
    assert result_of(**changes)["in_time"] == changes.keys().isdisjoint({"state", "time_limit"})
    assert not result_of(**changes)["success"]


def test_a_maze_without_a_ramp_asks_for_none():
    flat = replace(MAZE, ramp=None, sources=MAZE.sources[:1])
    truth = replace(TRUTH, launches=(SERVED,))
    result = result_of(flat, sources=(reported(0.0, 2.0),), truth=truth)
    assert result["success"]
    assert result["ramp_done"] is None


def test_what_is_not_known_is_none():
    result = result_of(sources=(), truth=replace(TRUTH, launches=()), ticks=ticks_of())
    for key in ("source_error_max", "launch_error_max", "stop_seconds_max", "pose_rmse"):
        assert result[key] is None
    assert result["launch_angle_max"] is None
    assert run_of().time == 250.0
