"""The pose at which each image was taken, when telemetries are lost, doubled or out of order."""

import math

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_common.types import CameraFrame
from rover_perception.frame_validation import FrameError, FrameGate

POSES = [Pose(90.0 + 0.1 * index, 100.0, 0.0) for index in range(6)]
PERIOD = 40_000_000  # [ns]


def frame(index: int, pose: Pose | None = None, shape=(160, 320, 3)) -> CameraFrame:
    """A telemetry with its pose; its image, of one pose before, differs from all others."""
    image = np.full(shape, index, np.uint8)
    return CameraFrame(PERIOD * (index + 1), pose or POSES[index], image)


@pytest.mark.parametrize("lag", [0, 1, 2])
def test_the_image_is_as_many_frames_older_as_the_lag_says(lag):
    gate = FrameGate(lag)
    taken = [gate.admit(frame(index)).pose for index in range(6)]
    assert taken == [POSES[max(0, index - lag)] for index in range(6)]


def test_telemetries_of_one_rendered_frame_have_one_image():
    gate = FrameGate(1)
    for index in (0, 1):
        gate.admit(frame(index))
    twins = [gate.admit(frame(2)).pose for _ in range(3)]
    assert twins == [POSES[1]] * 3
    assert gate.admit(frame(3)).pose == POSES[2]


def test_a_rover_that_has_stopped_is_seen_where_it_stands():
    gate = FrameGate(1)
    for index in (0, 1):
        gate.admit(frame(index))
    standing = [gate.admit(frame(index, POSES[1])).pose for index in (2, 3)]
    assert standing == [POSES[1]] * 2


def test_a_pose_of_a_frame_without_a_usable_image_still_counts():
    gate = FrameGate(1)
    gate.admit(frame(0))
    with pytest.raises(FrameError):
        gate.admit(frame(1, shape=(10, 10, 3)))
    assert gate.admit(frame(2)).pose == POSES[1]


@pytest.mark.parametrize("bad", [Pose(math.nan, 100, 0), Pose(90, -1, 0), Pose(90, 200, 0)])
def test_after_a_lost_pose_an_older_one_is_not_taken_instead(bad):
    gate = FrameGate(1)
    gate.admit(frame(0))
    with pytest.raises(FrameError):
        gate.admit(frame(1, bad))
    assert gate.admit(frame(2)).pose == POSES[2]
    assert gate.admit(frame(3)).pose == POSES[2]


def test_after_time_fell_back_a_later_pose_is_not_taken():
    gate = FrameGate(1)
    for index in (3, 4):
        gate.admit(frame(index))
    admission = gate.admit(frame(1))
    assert admission.pose == POSES[1]
    assert not admission.new_run


def test_a_new_run_is_a_clock_that_falls_back_or_a_rover_far_away():
    gate = FrameGate(1)
    gate.admit(frame(0))
    assert not gate.admit(frame(1)).new_run
    elsewhere = Pose(20.0, 20.0, 1.0)
    admission = gate.admit(frame(2, elsewhere))
    assert admission.new_run
    assert admission.pose == elsewhere
    late = CameraFrame(1_000 * PERIOD, elsewhere, frame(3).image)
    assert not gate.admit(late).new_run
    assert gate.admit(frame(4, elsewhere)).new_run
