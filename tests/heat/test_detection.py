"""When a frame shows heat, and where."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from warm_room import Patch, Room, box

from rover_common.geometry import Pose
from rover_heat.config import HeatConfig
from rover_heat.thermal.detection import AZIMUTHS, PIXEL, find_patch
from rover_heat.thermal.stuck_pixels import StuckPixels

CONFIG = HeatConfig()
ABSOLUTE, BOTH = replace(CONFIG, heat_rule="absolute"), replace(CONFIG, heat_rule="both")


def frame(air: float, spots: dict[tuple[int, int], float]) -> np.ndarray:
    celsius = np.full((8, 8), air)
    for at, excess in spots.items():
        celsius[at] += excess
    return celsius


@pytest.mark.parametrize(
    ("celsius", "contrast", "absolute"),
    [
        (frame(24.0, {}), False, False),
        (frame(28.0, {}), False, True),  # a sensor that reads too much
        (frame(24.0, {(3, 3): 2.4}), False, False),
        (frame(24.0, {(3, 3): 2.5}), True, False),
        (frame(24.0, {(3, 3): 3.0}), True, True),
        (frame(24.0, {(2, 2): 3.0}), True, True),
        (frame(24.0, {(5, 5): 3.0}), True, True),
        (frame(24.0, {(1, 3): 9.0}), True, False),  # not one of the 16 in the centre
        (frame(24.0, {(3, 6): 9.0}), True, False),
        (frame(18.0, {(3, 3): 8.0}), True, False),  # a cold room
        (frame(-5.0, {(3, 3): 8.0}), True, False),
    ],
)
def test_the_rules(celsius, contrast, absolute):
    assert (find_patch(celsius, CONFIG) is not None) == contrast
    assert (find_patch(celsius, ABSOLUTE) is not None) == absolute
    assert (find_patch(celsius, BOTH) is not None) == (contrast and absolute)


def test_columns_count_from_the_left():
    assert find_patch(frame(24.0, {(3, 1): 9.0}), CONFIG).azimuth == pytest.approx(2.5 * PIXEL)
    assert find_patch(frame(24.0, {(3, 6): 9.0}), CONFIG).azimuth == pytest.approx(-2.5 * PIXEL)
    assert AZIMUTHS[0] - AZIMUTHS[7] == pytest.approx(math.radians(52.5))


def test_the_bearing_lies_between_pixels_by_their_excess():
    celsius = frame(24.0, {(3, 3): 8.0, (3, 4): 8.0})
    assert find_patch(celsius, CONFIG).azimuth == pytest.approx(0.0)
    celsius = frame(24.0, {(3, 3): 8.0, (3, 4): 5.0})
    assert 0.0 < find_patch(celsius, CONFIG).azimuth < AZIMUTHS[3]


@pytest.mark.parametrize("column", range(8))
def test_a_patch_at_the_border_is_cut(column):
    found = find_patch(frame(24.0, {(3, column): 9.0}), CONFIG)
    assert found.cut == (column in (0, 7))


@pytest.mark.parametrize("aside", np.radians([-20.0, -11.0, -3.0, 0.0, 5.0, 13.0, 20.0]))
@pytest.mark.parametrize("distance", [0.3, 0.6, 1.0, 1.5])
def test_the_bearing_of_a_patch_on_a_wall(distance, aside):
    patch = Patch(wall=2, along=1.5)
    room = Room(box(3.0, 3.0), (patch,))
    x, y = room.place_of(patch)
    found = find_patch(room.celsius(Pose(x, y - distance, math.pi / 2 - aside), 0.0), CONFIG)
    assert found.azimuth == pytest.approx(aside, abs=math.radians(3.5))
    assert found.peak > 3.0


def test_a_pixel_that_is_hot_wherever_the_robot_turns_is_left_out():
    stuck = StuckPixels()
    celsius = frame(24.0, {(2, 5): 20.0})
    found = [
        stuck.update(find_patch(stuck.mended(celsius), CONFIG), math.radians(yaw))
        for yaw in range(60)
    ]
    assert found.index(True) == 40
    assert found.count(True) == stuck.count == 1
    assert find_patch(stuck.mended(celsius), CONFIG) is None
    warm = frame(24.0, {(2, 5): 20.0, (4, 3): 6.0, (4, 4): 6.0})
    assert find_patch(stuck.mended(warm), CONFIG).pixel == (4, 3)


def test_a_patch_on_a_wall_is_no_stuck_pixel():
    patch = Patch(wall=2, along=1.5)
    room = Room(box(3.0, 3.0), (patch,))
    stuck = StuckPixels()
    for yaw in np.radians(np.arange(0.0, 720.0, 2.0)):
        celsius = room.celsius(Pose(1.5, 0.6, yaw), 0.0)
        assert not stuck.update(find_patch(celsius, CONFIG), yaw)
    straight = Pose(1.5, 0.6, math.pi / 2)
    for _ in range(200):
        assert not stuck.update(find_patch(room.celsius(straight, 0.0), CONFIG), straight.yaw)
