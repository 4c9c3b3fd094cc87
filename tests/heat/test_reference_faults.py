"""What went wrong with the system that this mission is measured against, and cannot here.

Its other faults are tests elsewhere: rules of tilt in test_tilt, marks in test_ramp, arrivals in
test_trip, clusters in test_sources, clocks in test_bad_input.
"""

from __future__ import annotations

import math
from dataclasses import replace

from driven_heat import STAND
from reached_heat import exploring, launching, navigating
from readme_tables import ROOT

from rover_common.geometry import Pose
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State


def test_no_wait_takes_the_place_of_an_arrival():
    driven = navigating(HeatConfig(time_limit=300.0))
    for _ in range(60):
        driven.ticks(1.0)
        driven.goal.distance_left -= 0.06  # it gets on, and does not arrive
    assert driven.state is State.GOAL_NAVIGATION
    assert driven.launches == 0


def test_a_robot_that_faces_away_turns_before_it_launches():
    driven = launching()
    driven.pose = replace(STAND.pose, yaw=STAND.pose.yaw - 0.7)
    for _ in range(80):
        twist = driven.tick().twist
        assert driven.launches == 0
        assert twist.linear == 0.0
    assert twist.angular > 0.0
    driven.pose = STAND.pose
    driven.until(lambda made: made.launch, 2.0)


def test_a_source_behind_the_wall_is_not_served_from_there():
    driven = navigating()
    driven.move_to(Pose(2.0, 3.0, -math.pi / 2))
    driven.ticks(2.0)
    assert driven.launches == 0


def test_a_goal_is_given_once_and_nothing_is_sent_beside_it():
    driven = exploring()
    sent = driven.ticks(10.0)
    assert len(driven.navigator.goals) == 1
    assert {decision.twist for decision in sent[20:]} == {None}


def test_nothing_sleeps():
    for path in (ROOT / "rover_heat" / "rover_heat").rglob("*.py"):
        assert "sleep" not in path.read_text(), path
