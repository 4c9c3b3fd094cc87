"""Where a warm frame and a scan say that the heat is."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from warm_room import Patch, Room, box, hits_of

from rover_common.geometry import Pose, wrap_angle
from rover_heat.config import HeatConfig, thermal_yaw
from rover_heat.thermal.detection import WarmPatch, find_patch
from rover_heat.thermal.fix import Fix, View, make_fix

CONFIG = HeatConfig()
AXIS = replace(CONFIG, heat_bearing="axis")
ORIGIN = Pose(0.0, 0.0, 0.0)
WARM = WarmPatch(0.0, 8.0, (3, 3), alone=False, cut=False)
STUB = np.array([[1.5, 0.0, 1.5, 0.6], [0.0, 1.4, 0.9, 1.4]])  # walls that stand in the room


def fix_from(
    room: Room, pose: Pose, sensor: int = 2, config: HeatConfig = CONFIG, rng=None
) -> Fix | None:
    patch = find_patch(room.celsius(pose, thermal_yaw(config, sensor), rng), config)
    if patch is None:
        return None
    return make_fix(patch, View(0, sensor, pose, 0.0, 0.0, hits_of(room, pose, rng)), config)


def view(hits: np.ndarray, pose: Pose = ORIGIN, **motion: float) -> View:
    return View(0, 2, pose, motion.get("speed", 0.0), motion.get("turn_rate", 0.0), hits)


def wall_at(distance: float, half_angle: float, count: int = 9) -> np.ndarray:
    """Points of an arc ahead."""
    angles = np.linspace(-half_angle, half_angle, count)
    return distance * np.stack([np.cos(angles), np.sin(angles)], axis=1)


@pytest.mark.parametrize("sensor", [1, 2])
@pytest.mark.parametrize("distance", [0.3, 0.5, 1.0, 1.5])
@pytest.mark.parametrize("aside", [-0.25, 0.0, 0.3])
def test_a_fix_lies_on_the_wall_where_the_heat_is(sensor, distance, aside):
    patch = Patch(wall=2, along=1.5)
    room = Room(box(3.0, 3.0), (patch,))
    x, y = room.place_of(patch)
    yaw = math.pi / 2 - thermal_yaw(CONFIG, sensor) - aside
    found = fix_from(room, Pose(x, y - distance, yaw), sensor)
    assert math.dist((found.x, found.y), (x, y)) < 0.06
    assert abs(wrap_angle(found.normal + math.pi / 2)) < math.radians(3.0)  # of a wall to the north
    assert found.range == pytest.approx(distance, abs=0.05)


def test_the_bearing_is_that_of_the_pixels_and_not_of_the_axis():
    patch = Patch(wall=2, along=1.5)
    room = Room(box(3.0, 3.0), (patch,))
    x, y = room.place_of(patch)
    pose = Pose(x, y - 1.0, math.pi / 2 + math.radians(14.0))
    assert fix_from(room, pose).x == pytest.approx(x, abs=0.06)
    assert fix_from(room, pose, config=AXIS).x < x - 0.2


def test_fixes_of_random_views_are_as_near_as_the_specified_share():
    rng = np.random.default_rng(5)
    errors = []
    patch = Patch(wall=2, along=1.5)
    room = Room(np.vstack([box(3.0, 2.5), STUB]), (patch,))
    place = room.place_of(patch)
    for _ in range(1500):
        pose = Pose(rng.uniform(0.2, 2.8), rng.uniform(0.2, 2.3), rng.uniform(-3.1, 3.1))
        found = fix_from(room, pose, rng=rng)
        if found is not None:
            errors.append(math.dist((found.x, found.y), place))
    assert len(errors) > 60
    assert np.mean(np.array(errors) < 0.15) > 0.9
    assert np.median(errors) < 0.04


def test_random_views_of_a_cold_room_give_none():
    rng = np.random.default_rng(6)
    room = Room(np.vstack([box(3.0, 2.5), STUB]))
    for _ in range(500):
        pose = Pose(rng.uniform(0.2, 2.8), rng.uniform(0.2, 2.3), rng.uniform(-3.1, 3.1))
        assert fix_from(room, pose, rng=rng) is None


def test_a_patch_that_the_image_cuts_gives_none():
    hits = wall_at(1.0, 0.5)
    assert make_fix(WARM, view(hits), CONFIG) is not None
    assert make_fix(replace(WARM, cut=True), view(hits), CONFIG) is None


def test_there_is_none_beyond_the_reach_and_none_without_rays():
    assert make_fix(WARM, view(wall_at(2.4, 0.1)), CONFIG) is not None
    assert make_fix(WARM, view(wall_at(2.6, 0.1)), CONFIG) is None
    assert make_fix(WARM, view(np.empty((0, 2))), CONFIG) is None
    behind = wall_at(1.0, 0.1) * (-1.0, 1.0)
    assert make_fix(WARM, view(behind), CONFIG) is None


@pytest.mark.parametrize(
    ("near_rays", "expected", "sharp"),
    [(0, 2.0, True), (2, 2.0, True), (4, 1.0, False), (5, 1.0, False), (9, 1.0, True)],
)
def test_of_two_surfaces_the_nearer_wins_with_a_third_of_the_rays(near_rays, expected, sharp):
    angles = np.linspace(-0.06, 0.06, 9)
    ranges = np.where(np.arange(9) < near_rays, 1.05, 2.05)
    hits = ranges[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    found = make_fix(WARM, view(hits), CONFIG)
    assert found.range == pytest.approx(expected, abs=0.1)
    assert found.sharp == sharp


@pytest.mark.parametrize("far", [1.5, 3.0])  # [m] within the reach of a fix, and beyond it
def test_past_a_walls_end_no_fix_is_sharp(far):
    half = CONFIG.heat_window
    near = wall_at(0.33, half)[4:]  # the left half
    beyond = wall_at(far, half)[:4]
    found = make_fix(WARM, view(np.concatenate([near, beyond])), CONFIG)
    assert found.range == pytest.approx(0.33, abs=0.01)
    assert not found.sharp


@pytest.mark.parametrize(("distance", "sharp"), [(0.33, False), (0.55, False), (0.7, True)])
def test_one_warm_pixel_alone_is_no_patch_on_a_near_wall(distance, sharp):
    alone = replace(WARM, alone=True)
    wall = wall_at(distance, 0.5, 90)
    assert make_fix(alone, view(wall), CONFIG).sharp == sharp
    assert make_fix(WARM, view(wall), CONFIG).sharp


def test_along_a_wall_no_fix_is_sharp():
    room = Room(np.array([[-3.0, 0.0, 3.0, 0.0]]))
    for yaw, sharp in ((-40.0, True), (-30.0, False)):
        pose = Pose(-1.0, 0.5, math.radians(yaw))
        assert make_fix(WARM, view(hits_of(room, pose), pose), CONFIG).sharp == sharp


def test_the_covariance_grows_along_the_wall_with_range_and_turning():
    near = make_fix(WARM, view(wall_at(0.5, 0.5, 60)), CONFIG)
    far = make_fix(WARM, view(wall_at(2.0, 0.5, 60)), CONFIG)
    turning = make_fix(WARM, view(wall_at(2.0, 0.5, 60), turn_rate=0.3), CONFIG)
    xx, xy, yx, yy = far.covariance
    assert xy == pytest.approx(yx, abs=1e-9)
    assert yy > xx > 0.0  # the wall is ahead, so along it is y
    assert near.covariance[3] < yy < turning.covariance[3]


def test_the_normal_tells_the_side_that_was_seen():
    room = Room(np.array([[-1.0, 0.0, 1.0, 0.0]]))
    for y in (0.8, -0.8):
        pose = Pose(0.1, y, -math.copysign(math.pi / 2, y))
        found = make_fix(WARM, view(hits_of(room, pose), pose), CONFIG)
        assert found.normal == pytest.approx(math.copysign(math.pi / 2, y), abs=0.05)
