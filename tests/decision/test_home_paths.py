"""Paths home: which method is in force, and when the next one takes over."""

import math

import pytest
from frames_by_hand import AWAY, frame
from maps import MIDDLE, straight_plan

from rover_common.geometry import Pose
from rover_common.types import PolarArray
from rover_decision.missions.sample_return.home_paths import (
    MAX_STUCK,
    METHODS,
    PATIENCE,
    HomePaths,
    bearing_home,
)

HOME = (MIDDLE.x, MIDDLE.y)
FAR = Pose(MIDDLE.x + 50.0, MIDDLE.y, math.pi)


@pytest.mark.parametrize("preferred", [method.name for method in METHODS])
def test_the_methods_follow_each_other_from_the_preferred_one_on(preferred):
    paths = HomePaths(preferred)
    order = []
    for step in range(len(METHODS) + 1):
        order.append(paths.method.name)
        time = 100.0 * step
        paths.begin(time)
        paths.update(time, FAR, HOME, None)
        paths.update(time + PATIENCE + 0.1, FAR, HOME, None)
    assert order[0] == order[-1] == preferred
    assert set(order) == {method.name for method in METHODS}


def test_a_method_that_brings_the_rover_nearer_is_kept():
    paths = HomePaths("bearing")
    paths.begin(0.0)
    for step in range(40):
        paths.update(4.0 * step, Pose(MIDDLE.x + 200.0 - step, MIDDLE.y, 0.0), HOME, None)
        assert paths.method.name == "bearing"


def test_a_method_on_which_the_rover_gets_stuck_again_is_left():
    paths = HomePaths("shortest_path")
    for _ in range(MAX_STUCK):
        assert paths.method.name == "shortest_path"
        paths.begin(0.0)
        paths.got_stuck()
    assert paths.method.name != "shortest_path"


def test_the_bearing_method_ignores_the_plan():
    plan = straight_plan()
    assert len(HomePaths("breadcrumbs").method.path(plan, AWAY)) > 0
    assert len(HomePaths("bearing").method.path(plan, AWAY)) == 0


def test_the_bearing_home_lies_on_navigable_ground():
    nav = frame(1.0).nav
    assert abs(bearing_home(nav, FAR, HOME)) < 0.05
    behind = bearing_home(nav, Pose(FAR.x, FAR.y, 0.0), HOME)
    assert nav.bearings.min() < behind < nav.bearings.max()
    assert bearing_home(PolarArray.empty(), FAR, HOME) is None
