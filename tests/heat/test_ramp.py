"""Where the ramp is taken to be, and what is kept free around it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mapped_rooms import is_in, map_of
from warm_room import Room, box, hits_of

from rover_common.geometry import Pose, wrap_angle
from rover_common.types import GridMap
from rover_heat.ramp.estimate import estimate_ramp
from rover_heat.ramp.hazards import NO_HAZARDS
from rover_heat.tilt import Lean

FOOT = (0.50, 1.53)  # [m] of a ramp that rises to the north in a strip of 1.02 m
STRIP = Room(box(1.02, 3.28))
BEYOND = 0.06  # [m] where the tilt is noticed
RISE = 0.07  # [rad]


def met(x: float, y: float, yaw: float, roll: float = 0.0, pitch: float = -RISE):
    pose = Pose(x, y, yaw)
    return estimate_ramp(pose, Lean(roll, pitch), hits_of(STRIP, pose))


@pytest.mark.parametrize("aside", [-0.2, 0.0, 0.15])
@pytest.mark.parametrize("turned", [-0.35, 0.0, 0.3])
def test_the_foot_lies_in_the_middle_of_the_strip_where_the_tilt_began(aside, turned):
    north = math.pi / 2
    lean = {"pitch": -RISE * math.cos(turned), "roll": -RISE * math.sin(turned)}
    ramp = met(FOOT[0] + aside, FOOT[1] + BEYOND, north + turned, **lean)
    assert abs(wrap_angle(ramp.yaw - north)) < math.radians(2.0)
    assert ramp.y == pytest.approx(FOOT[1], abs=0.03)
    assert ramp.x == pytest.approx(0.51, abs=0.03)
    assert ramp.straight


def test_a_robot_that_backs_onto_a_ramp_knows_it_behind_itself():
    ramp = met(FOOT[0], FOOT[1] + BEYOND - 0.02, -math.pi / 2, pitch=RISE)
    assert abs(wrap_angle(ramp.yaw - math.pi / 2)) < math.radians(2.0)


@pytest.mark.parametrize(("aside", "roll"), [(0.22, 0.068), (-0.24, -0.092)])
@pytest.mark.parametrize(
    ("turned", "pitch", "rise"), [(0.1, -0.013, 1), (-0.2, -0.027, 1), (0.1, 0.013, -1)]
)
def test_one_wheel_beside_the_ramp_tells_its_rise_by_the_pitch(aside, roll, turned, pitch, rise):
    north = math.pi / 2
    ramp = met(FOOT[0] + aside, FOOT[1] + BEYOND, north + turned, roll=roll, pitch=pitch)
    assert abs(wrap_angle(ramp.yaw - rise * north)) < math.radians(2.0)
    assert ramp.x == pytest.approx(0.51, abs=0.03)
    assert ramp.straight


def test_one_wheel_up_without_pitch_does_not_tell_the_rise():
    assert not met(FOOT[0], FOOT[1], math.pi / 2, roll=RISE, pitch=-0.003).straight


def test_a_flank_that_is_met_across_the_strip_does_not_tell_the_rise():
    assert not met(0.3, 2.0, 0.0, pitch=-RISE, roll=0.01).straight
    assert met(0.3, 2.0, 0.0, roll=RISE, pitch=-0.03).straight


def test_without_walls_beside_the_robots_own_path_is_the_middle():
    pose = Pose(0.0, 0.0, 0.4)
    ramp = estimate_ramp(pose, Lean(0.0, -RISE), np.empty((0, 2)))
    assert ramp.yaw == pytest.approx(0.4)
    assert ramp.along_and_across(0.0, 0.0) == pytest.approx((0.055, 0.0))


def test_poses_before_the_foot_face_the_ramp():
    ramp = met(FOOT[0], FOOT[1] + BEYOND, math.pi / 2)
    pose = ramp.before_foot(0.5)
    assert ramp.along_and_across(pose.x, pose.y) == pytest.approx((-0.5, 0.0))
    assert pose.yaw == ramp.yaw


@pytest.fixture
def blocked():
    ramp = met(FOOT[0], FOOT[1] + BEYOND, math.pi / 2)
    hazards = NO_HAZARDS.with_ramp(ramp, 1.25).with_disc(Pose(FOOT[0], FOOT[1] + BEYOND, 0.0))
    return ramp, hazards


def test_the_marks_cover_the_ramp_from_before_its_foot(blocked):
    ramp, hazards = blocked
    grid = hazards.drawn_into(map_of(STRIP, [(0.5, 0.5)]))
    for along in (-0.07, 0.1, 0.6, 1.1):
        for across in (-0.2, 0.0, 0.2):
            x = ramp.x + along * math.cos(ramp.yaw) - across * math.sin(ramp.yaw)
            y = ramp.y + along * math.sin(ramp.yaw) + across * math.cos(ramp.yaw)
            assert is_in(grid, (x, y), 100), (along, across)
    assert is_in(grid, ramp.before_foot(0.22), 0)
    assert is_in(grid, ramp.before_foot(0.5), 0)


@pytest.mark.parametrize(
    ("resolution", "shift"), [(0.05, 0.0), (0.05, -1.0), (0.025, 0.0), (0.1, -0.37)]
)
def test_the_marks_stay_where_they_are_when_another_map_comes(blocked, resolution, shift):
    ramp, hazards = blocked
    plain = map_of(STRIP, [(0.5, 0.5)], resolution)
    rows, cols = plain.cells.shape
    larger = np.zeros((rows + 60, cols + 60), np.int8)
    grid = GridMap(resolution, plain.origin_x + shift, plain.origin_y + shift, larger)
    drawn = hazards.drawn_into(grid)
    row, col = np.nonzero(drawn.cells == 100)
    x = grid.origin_x + (col + 0.5) * resolution
    y = grid.origin_y + (row + 0.5) * resolution
    along, across = np.array([ramp.along_and_across(*p) for p in zip(x, y, strict=True)]).T
    assert along.min() == pytest.approx(0.055 - 0.20, abs=resolution)  # the disc's side
    assert along.max() == pytest.approx(1.15, abs=resolution)
    assert np.abs(across).max() == pytest.approx(0.25, abs=resolution)
    assert np.array_equal(larger, np.zeros_like(larger))  # the map itself is not written to


def test_unknown_cells_stay_unknown(blocked):
    _, hazards = blocked
    unknown = GridMap(0.05, 0.0, 0.0, np.full((80, 40), -1, np.int8))
    assert (hazards.drawn_into(unknown).cells == -1).all()
    assert NO_HAZARDS.drawn_into(unknown) is unknown
