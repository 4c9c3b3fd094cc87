"""Of any message a conversion makes something that can be used, or it refuses the message."""

from __future__ import annotations

import math
from array import array
from typing import Any

import numpy as np
import pytest
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped, Vector3
from hypothesis import given
from hypothesis import strategies as st
from nav_msgs.msg import OccupancyGrid, Odometry
from rover_interfaces.msg import PolarArray, RockTrack, RockTrackArray, RoverStatus
from sensor_msgs.msg import Image, Imu, LaserScan
from std_msgs.msg import Header

from rover_common import frames
from rover_common.ros import conversions, sensor_conversions
from rover_common.ros.message_checks import MessageError
from rover_common.ros.transforms import pose_of_transform


def rotation(x: float, y: float, z: float, w: float) -> Quaternion:
    return Quaternion(x=x, y=y, z=z, w=w)


NUMBERS = st.one_of(st.sampled_from([0.0, 0.5, 1.0, math.nan, math.inf, -math.inf]), st.floats())
NUMBERS32 = st.one_of(
    st.sampled_from([0.0, 0.5, 1.0, math.nan, math.inf]),
    st.floats(-(2.0**120), 2.0**120, width=32),
)
FLOATS = st.lists(NUMBERS32, max_size=6).map(lambda values: array("f", values))
NAMES = st.sampled_from(["", "map", "odom", "base_link", "robot/odom", "robot/map", "moon"])
HEADERS = st.builds(Header, frame_id=NAMES)
UNIT = st.tuples(*[st.floats(-1.0, 1.0)] * 4).filter(lambda q: math.hypot(*q) > 0.1)
ROTATIONS = st.one_of(
    st.builds(Quaternion, x=NUMBERS, y=NUMBERS, z=NUMBERS, w=NUMBERS),
    UNIT.map(lambda q: rotation(*(value / math.hypot(*q) for value in q))),
    st.just(Quaternion()),
)
POINTS = st.builds(Point, x=NUMBERS, y=NUMBERS)
VECTORS = st.builds(Vector3, x=NUMBERS, y=NUMBERS, z=NUMBERS)


@st.composite
def odometries(draw: Any) -> Odometry:
    message = Odometry(header=draw(HEADERS))
    message.pose.pose.position, message.pose.pose.orientation = draw(POINTS), draw(ROTATIONS)
    message.twist.twist.linear.x = draw(NUMBERS)
    return message


@st.composite
def grids(draw: Any) -> OccupancyGrid:
    message = OccupancyGrid(header=draw(HEADERS))
    info = message.info
    info.height, info.width = draw(st.integers(0, 5)), draw(st.integers(0, 5))
    info.resolution = draw(st.one_of(st.just(0.25), NUMBERS32))
    info.origin = Pose(position=draw(POINTS), orientation=draw(ROTATIONS))
    size = draw(st.one_of(st.just(info.height * info.width), st.integers(0, 30)))
    message.data = array("b", [0] * size)
    return message


@st.composite
def images(draw: Any) -> Image:
    height, width = draw(st.integers(0, 4)), draw(st.integers(0, 4))
    step = draw(st.integers(0, 16))
    size = draw(st.one_of(st.just(height * step), st.integers(0, 64)))
    encoding = draw(st.sampled_from(["rgb8", "bgr8", "mono8", ""]))
    data = array("B", range(size))
    return Image(height=height, width=width, step=step, encoding=encoding, data=data)


SCANS = st.builds(
    LaserScan, header=HEADERS, angle_min=NUMBERS32, angle_increment=NUMBERS32,
    time_increment=NUMBERS32, range_min=NUMBERS32, range_max=NUMBERS32, ranges=FLOATS,
)  # fmt: skip
ROCKS = st.builds(
    RockTrackArray,
    header=HEADERS,
    rocks=st.lists(
        st.builds(RockTrack, position=POINTS, covariance=st.lists(NUMBERS, min_size=4, max_size=4)),
        max_size=2,
    ),
)
IMUS = st.builds(Imu, orientation=ROTATIONS, angular_velocity=VECTORS, linear_acceleration=VECTORS)


def usable(convert: Any, *messages: Any) -> Any:
    """What is made of the messages; None where they are refused."""
    try:
        return convert(*messages)
    except MessageError as error:
        assert "\n" not in str(error)
        return None


@given(odometries())
def test_a_state_is_finite_and_of_a_rotation(message):
    state = usable(conversions.vehicle_state_of, message, RoverStatus())
    if state is not None:
        pose = state.pose
        assert np.isfinite([pose.x, pose.y, pose.yaw, pose.pitch, pose.roll, state.speed]).all()
        q = message.pose.pose.orientation
        assert math.hypot(q.x, q.y, q.z, q.w) == pytest.approx(1.0, abs=0.02)
        assert message.header.frame_id != "moon"


@given(grids())
def test_a_grid_has_the_cells_that_it_says(message):
    grid = usable(conversions.grid_of, message)
    if grid is not None:
        assert grid.cells.shape == (message.info.height, message.info.width)
        assert grid.cells.size > 0
        assert 0.0 < grid.resolution < math.inf
        assert math.isfinite(grid.origin_x) and math.isfinite(grid.origin_y)


@given(images())
def test_an_image_of_any_legal_step_shows_its_pixels(message):
    image = usable(conversions.image_of, message)
    legal = (
        message.encoding == "rgb8"
        and message.height * message.width > 0
        and message.step >= 3 * message.width
        and len(message.data) == message.height * message.step
    )
    assert (image is not None) == legal
    if image is not None:
        assert image.shape == (message.height, message.width, 3)
        row, col = message.height - 1, message.width - 1
        assert image[row, col, 2] == message.data[row * message.step + 3 * col + 2]


@given(SCANS)
def test_a_free_scan_is_a_fan_of_distances(message):
    scan = usable(conversions.scan_of, message)
    if scan is not None:
        assert len(scan.ranges) > 0
        assert (scan.ranges >= 0.0).all()
        assert math.isfinite(scan.angle_min) and scan.angle_increment != 0.0


@given(SCANS)
def test_a_laser_scan_is_a_fan(message):
    scan = usable(sensor_conversions.laser_scan_of, message)
    if scan is not None:
        assert len(scan.ranges) > 0
        assert np.isfinite([scan.angle_min, scan.angle_increment, scan.time_increment]).all()


@given(HEADERS, FLOATS, FLOATS)
def test_a_polar_array_has_a_bearing_for_each_range(header, ranges, bearings):
    message = PolarArray(header=header, ranges=ranges, bearings=bearings)
    polar = usable(conversions.polar_of, message)
    if polar is not None:
        assert len(polar.ranges) == len(polar.bearings)
        assert np.isfinite(polar.ranges).all() and np.isfinite(polar.bearings).all()


@given(ROCKS)
def test_rocks_are_at_places(message):
    for rock in usable(conversions.rocks_of, message) or ():
        assert np.isfinite([rock.x, rock.y, *rock.covariance]).all()


@given(odometries())
def test_wheel_odometry_is_finite(message):
    odometry = usable(sensor_conversions.wheel_odometry_of, message)
    if odometry is not None:
        pose, twist = odometry.pose, odometry.twist
        assert np.isfinite([pose.x, pose.y, pose.yaw, twist.linear, twist.angular]).all()


@given(IMUS)
def test_an_imu_is_finite(message):
    imu = usable(sensor_conversions.imu_of, message)
    if imu is not None:
        assert np.isfinite([*imu.angular_velocity, *imu.linear_acceleration]).all()
        if imu.orientation is not None:
            assert math.hypot(*imu.orientation) == pytest.approx(1.0, abs=0.02)


@given(VECTORS, ROTATIONS)
def test_a_transform_is_a_pose(translation, rotation):
    message = TransformStamped()
    message.transform.translation, message.transform.rotation = translation, rotation
    pose = usable(pose_of_transform, message)
    if pose is not None:
        assert np.isfinite([pose.x, pose.y, pose.yaw]).all()


@pytest.mark.parametrize("length", [0.0, 0.5, 2.0])
def test_an_orientation_of_another_length_is_no_angle(length):
    message = Odometry()
    message.pose.pose.orientation = Quaternion(x=0.0, y=0.0, z=0.0, w=length)
    with pytest.raises(MessageError, match="length"):
        conversions.pose_of(message)


def test_frames_with_a_prefix_and_without_a_name_are_taken():
    for name in ("", frames.ODOM, f"robot_1/{frames.ODOM}"):
        conversions.pose_of(Odometry(header=Header(frame_id=name)))
    with pytest.raises(MessageError, match="frame 'camera'"):
        conversions.pose_of(Odometry(header=Header(frame_id="camera")))
