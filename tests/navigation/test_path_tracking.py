"""Path tracking: steering and speed along a path."""

import math

import numpy as np
import pytest
from maps import MIDDLE, SCALE, straight_plan
from scans import open_scan

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_navigation.actuation import Actuation, approach_speed
from rover_navigation.local_clearance import LocalClearance
from rover_navigation.path_tracking import PathTracker, path_length, remaining
from rover_navigation.types import Path

TRACKER = PathTracker(Actuation(ROVER), SCALE, top_speed=4.0)
OPEN = LocalClearance.of(open_scan(), 0.5)
STRAIGHT = straight_plan().path


def bend(radius: float) -> Path:
    """A quarter of a circle to the left."""
    angle = np.linspace(0, math.pi / 2, 12)
    points = np.stack(
        [MIDDLE.x + radius * np.sin(angle), MIDDLE.y + radius * (1 - np.cos(angle))], axis=1
    )
    return Path(points, np.full(len(points), 5.0))


def test_curves_are_driven_slower_than_straights():
    around = TRACKER.command(MIDDLE, 2.5, bend(4.0), OPEN)
    straight = TRACKER.command(MIDDLE, 2.5, STRAIGHT, OPEN)
    assert straight.throttle > 0
    assert around.throttle < straight.throttle
    assert around.steering_angle > 0


def test_the_robot_steers_back_to_the_path():
    left = TRACKER.command(Pose(MIDDLE.x, MIDDLE.y + 0.5, 0.0), 1.0, STRAIGHT, OPEN)
    right = TRACKER.command(Pose(MIDDLE.x, MIDDLE.y - 0.5, 0.0), 1.0, STRAIGHT, OPEN)
    assert left.steering_angle < 0 < right.steering_angle


def test_an_obstacle_in_the_corridor_limits_the_speed():
    near = LocalClearance.of(open_scan(1.5), 0.5)
    assert TRACKER.command(MIDDLE, 2.5, STRAIGHT, near).brake > 0
    assert TRACKER.command(MIDDLE, 2.5, STRAIGHT, OPEN).brake == 0


def test_a_path_behind_is_turned_to_in_place_without_the_brake():
    behind = Pose(MIDDLE.x, MIDDLE.y, math.pi)
    assert TRACKER.command(behind, 1.0, STRAIGHT, OPEN).brake == 1.0
    standing = TRACKER.command(behind, 0.0, STRAIGHT, OPEN)
    assert standing.throttle == standing.brake == 0.0
    assert abs(standing.steering_angle) == pytest.approx(ROVER.max_steering)


def test_the_end_of_the_path_is_reached_at_a_speed_to_stop_from():
    near_end = Pose(MIDDLE.x + 18.0, MIDDLE.y, 0.0)
    left = path_length(remaining(STRAIGHT, near_end), near_end)
    assert left < 2.0
    assert TRACKER.command(near_end, 1.1 * approach_speed(left) + 0.3, STRAIGHT, OPEN).brake > 0
    assert TRACKER.at_end(Pose(MIDDLE.x + 19.0, MIDDLE.y, 0.0), STRAIGHT)
    assert not TRACKER.at_end(near_end, STRAIGHT)


def test_what_remains_of_a_path_begins_beside_the_robot():
    beside = Pose(MIDDLE.x + 10.2, MIDDLE.y + 1.0, 0.0)
    rest = remaining(STRAIGHT, beside)
    assert rest.points[0, 0] == pytest.approx(MIDDLE.x + 10.0)
    assert rest.points[-1, 0] == STRAIGHT.points[-1, 0]
    assert len(rest.points) == len(rest.speeds)
