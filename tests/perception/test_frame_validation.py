"""The pose at which each image was taken, and the frames that are refused."""

import math

import numpy as np
import pytest

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.grid import WORLD
from rover_common.types import CameraFrame
from rover_perception.frame_validation import FrameError, FrameValidator

POSES = [Pose(90.0 + 0.1 * index, 100.0, 0.0) for index in range(6)]
PERIOD = 40_000_000  # [ns]


def frame(index: int, pose: Pose | None = None, shape=(160, 320, 3)) -> CameraFrame:
    """A telemetry with its pose; its image, of one pose before, differs from all others."""
    image = np.full(shape, index, np.uint8)
    return CameraFrame(PERIOD * (index + 1), pose or POSES[index], image)


def validator(image_lag: int = 1) -> FrameValidator:
    return FrameValidator(ROVER_CAMERA, WORLD.size, image_lag)


@pytest.mark.parametrize("lag", [0, 1, 2])
def test_the_image_is_as_many_frames_older_as_the_lag_says(lag):
    frames = validator(lag)
    poses = [frames.validate(frame(index)) for index in range(6)]
    assert poses == [POSES[max(0, index - lag)] for index in range(6)]


def test_telemetries_of_one_rendered_frame_have_one_image():
    frames = validator()
    for index in (0, 1):
        frames.validate(frame(index))
    repeated = [frames.validate(frame(2)) for _ in range(3)]
    assert repeated == [POSES[1]] * 3
    assert frames.validate(frame(3)) == POSES[2]


def test_the_pose_of_a_stopped_rover_is_where_it_stands():
    frames = validator()
    for index in (0, 1):
        frames.validate(frame(index))
    standing = [frames.validate(frame(index, POSES[1])) for index in (2, 3)]
    assert standing == [POSES[1]] * 2


def test_the_pose_of_a_frame_with_an_invalid_image_still_counts():
    frames = validator()
    frames.validate(frame(0))
    with pytest.raises(FrameError):
        frames.validate(frame(1, shape=(10, 10, 3)))
    assert frames.validate(frame(2)) == POSES[1]


@pytest.mark.parametrize("bad", [Pose(math.nan, 100, 0), Pose(90, -1, 0), Pose(90, 200, 0)])
def test_after_an_invalid_pose_no_older_one_is_used_instead(bad):
    frames = validator()
    frames.validate(frame(0))
    with pytest.raises(FrameError):
        frames.validate(frame(1, bad))
    assert frames.validate(frame(2)) == POSES[2]
    assert frames.validate(frame(3)) == POSES[2]


@pytest.mark.parametrize(
    ("pose", "shape", "counter"),
    [
        (Pose(math.nan, 0, 0), (160, 320, 3), "frame_pose_not_finite"),
        (Pose(0, 0, math.inf), (160, 320, 3), "frame_pose_not_finite"),
        (Pose(-50.0, 300.0, 0), (160, 320, 3), "frame_pose_outside"),
        (Pose(1e30, 100.0, 0), (160, 320, 3), "frame_pose_outside"),
        (Pose(90, 100, 0), (100, 320, 3), "frame_image_size"),
        (Pose(90, 100, 0), (160, 320), "frame_image_size"),
    ],
)
def test_an_invalid_frame_is_refused_by_its_counter(pose, shape, counter):
    with pytest.raises(FrameError) as error:
        validator().validate(CameraFrame(1, pose, np.zeros(shape, np.uint8)))
    assert error.value.counter == counter
