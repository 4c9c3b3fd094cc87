"""The pictures that perception draws for people."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scene import EXACT, corridor, draw, hall

from rover_common.geometry import Pose
from rover_common.types import CameraFrame
from rover_perception.camera.birdseye import NAVIGABLE, OBSTACLE, ROCK, birdseye_image
from rover_perception.perception import Perception

UNKNOWN = (0, 0, 0)
RANGE = EXACT.max_range
YELLOW = (180, 150, 30)


def seen_from_above(pose: Pose, image: NDArray[np.uint8], max_range: float = RANGE) -> NDArray:
    core = Perception(EXACT)
    core.process(CameraFrame(1, pose, image))
    assert core.segmentation is not None
    return birdseye_image(core.segmentation, max_range)


def at(picture: NDArray, ahead: float, left: float) -> tuple[int, ...]:
    """The colour at a place [m] of the level frame, by the layout that the README describes."""
    row, col = picture.shape[0] - 1 - int(ahead * 10), int(160 - left * 10)
    return tuple(int(level) for level in picture[row, col])


@pytest.mark.parametrize(
    "pose",
    [
        Pose(90.0, 100.0, 0.0),
        Pose(90.0, 100.0, 0.0, math.radians(1.5), math.radians(-1.5)),
        Pose(90.0, 100.0, 0.0, math.radians(-1.5), math.radians(1.5)),
    ],
)
def test_ground_and_walls_have_their_place_whatever_the_tilt(pose):
    picture = seen_from_above(pose, draw(pose, hall))  # walls 5 m to either side, 10 m ahead
    for ahead, left in ((1.5, 0.0), (3.0, 2.0), (6.0, -3.0), (7.0, 0.0)):
        assert at(picture, ahead, left) == NAVIGABLE, (ahead, left)
    for ahead, left in ((6.0, 6.0), (6.0, -6.0), (12.0, 0.0)):
        assert at(picture, ahead, left) == OBSTACLE, (ahead, left)


def test_left_and_right_are_not_swapped():
    pose = Pose(90.0, 100.0, 0.0)
    picture = seen_from_above(pose, draw(pose, lambda x, y: (y > 90.0) & (y < 102.0)))
    assert at(picture, 5.0, 4.0) == OBSTACLE  # the wall to the left is nearer
    assert at(picture, 5.0, -4.0) == NAVIGABLE


def test_what_the_camera_does_not_see_is_black():
    pose = Pose(90.0, 100.0, 0.0)
    picture = seen_from_above(pose, draw(pose, corridor))
    assert at(picture, 0.3, 0.0) == UNKNOWN  # nearer than the image's lower edge
    assert at(picture, 1.0, 3.0) == UNKNOWN  # beside the field of view


def test_nothing_is_shown_beyond_the_range():
    pose = Pose(90.0, 100.0, 0.0)
    picture = seen_from_above(pose, draw(pose, hall), max_range=5.0)
    assert at(picture, 4.5, 0.0) == NAVIGABLE
    assert at(picture, 5.5, 0.0) == UNKNOWN
    assert at(picture, 12.0, 0.0) == UNKNOWN


def test_ground_whose_end_is_not_known_does_not_turn_into_an_obstacle():
    pose = Pose(90.0, 100.0, 0.0)
    picture = seen_from_above(pose, draw(pose, lambda x, y: x < 1e9))  # up to the horizon
    assert at(picture, 3.0, 0.0) == NAVIGABLE
    assert at(picture, 8.0, 0.0) == UNKNOWN


def test_a_rock_is_green():
    pose = Pose(90.0, 100.0, 0.0)
    image = draw(pose, corridor)
    rock = draw(pose, lambda x, y: np.hypot(x - 93.0, y - 101.0) < 0.3, YELLOW)
    shown = (rock == YELLOW).all(axis=2)
    image[shown] = YELLOW
    picture = seen_from_above(pose, image)
    assert at(picture, 3.0, 1.0) == ROCK
    assert at(picture, 3.0, -1.0) == NAVIGABLE
    assert at(picture, 2.0, 1.0) == NAVIGABLE
