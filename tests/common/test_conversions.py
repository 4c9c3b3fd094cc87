"""Messages to dataclasses and back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_common.geometry import Pose
from rover_common.ros import conversions, scan_conversions
from rover_common.types import FIRST_RUN, Command, FreeScan, GridMap, PolarArray, RockTrack

STAMP = 12_345_678_901_234


@given(st.integers(0, 2**31 * 10**9 - 1))
def test_stamps(stamp):
    assert conversions.stamp_of(conversions.time_of(stamp)) == stamp


def test_odometry():
    pose = Pose(1.5, -2.5, 0.7, 0.1, -0.2)
    message = conversions.odometry_of(STAMP, pose, 1.25)
    back = conversions.pose_of(message)
    assert (back.x, back.y) == (1.5, -2.5)
    assert (back.yaw, back.pitch, back.roll) == pytest.approx((0.7, 0.1, -0.2))
    assert message.twist.twist.linear.x == 1.25


def test_image():
    image = np.random.default_rng(0).integers(0, 255, (4, 6, 3), np.uint8)
    message = conversions.image_message_of(STAMP, "camera", image)
    assert (conversions.image_of(message) == image).all()
    message.encoding = "bgr8"
    assert (conversions.image_of(message) == image[:, :, ::-1]).all()
    message.encoding = "mono16"
    with pytest.raises(conversions.MessageError, match="mono16"):
        conversions.image_of(message)
    message.encoding = "rgb8"
    message.height = 5
    with pytest.raises(conversions.MessageError, match="for 5 rows"):
        conversions.image_of(message)


def test_polar_and_scan():
    polar = PolarArray(np.array([1, 2], np.float32), np.array([-0.5, 0.5], np.float32))
    back = scan_conversions.polar_of(scan_conversions.polar_message_of(STAMP, FIRST_RUN, polar))
    assert (back.ranges == polar.ranges).all()
    assert (back.bearings == polar.bearings).all()
    ranges = np.array([1.0, np.inf, 2.0], np.float32)
    scan = FreeScan(-1.0, 1.0, 0.5, 12.0, ranges)
    message = scan_conversions.scan_message_of(STAMP, scan)
    assert message.angle_max == pytest.approx(1.0)
    assert (scan_conversions.scan_of(message).ranges == ranges).all()


def test_rocks():
    rocks = (RockTrack(7, 1.0, 2.0, (0.1, 0.0, 0.0, 0.2), 5, STAMP),)
    assert (
        conversions.rocks_of(conversions.rocks_message_of(STAMP, FIRST_RUN, rocks, STAMP)) == rocks
    )


def test_grid():
    cells = np.arange(-1, 5, dtype=np.int8).reshape(2, 3)
    back = conversions.grid_of(conversions.grid_message_of(STAMP, GridMap(1.0, 3.0, 4.0, cells)))
    assert (back.cells == cells).all()
    assert (back.resolution, back.origin_x, back.origin_y) == (1.0, 3.0, 4.0)


def test_command():
    command = Command(0.5, 0.0, -0.1, False)
    message = conversions.command_message_of(STAMP + 5, STAMP, FIRST_RUN, command)
    assert conversions.command_of(message) == (STAMP, command)
