"""Scans, tilt and poses before they meet a map: deskewing, odd rays, the pose buffer."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from maze_world import MazeWorld, box

from rover_common.geometry import Pose, compose, inverse, quaternion_from_pose, wrap_angle
from rover_common.sensor_types import Imu, LaserScan, Twist, WheelOdometry
from rover_navigation.localization.dead_reckoning import DeadReckoning
from rover_navigation.localization.pose_buffer import PoseBuffer, Trajectory
from rover_navigation.localization.scan_points import deskew, last_ray
from rover_navigation.localization.tilt_meter import TiltMeter

HALL = np.array(box(0.0, 0.0, 3.0, 2.0))
SECOND = 1_000_000_000


def standing() -> Trajectory:
    track = Trajectory()
    for stamp in (0, SECOND):
        track.add(stamp, Pose(0.0, 0.0, 0.0))
    return track


def scan_of(ranges: list[float], angle_min: float = 0.0, increment: float = 0.1) -> LaserScan:
    return LaserScan(0, angle_min, increment, 1e-3, 0.16, 8.0, np.array(ranges, np.float32))


def test_the_parts_of_a_chain_compose_and_invert():
    a, b = Pose(1.0, 2.0, 2.5), Pose(-0.3, 0.4, 1.7)
    back = compose(inverse(a), compose(a, b))
    assert (back.x, back.y, back.yaw) == pytest.approx((b.x, b.y, b.yaw))


def test_a_pose_between_two_stamps_is_interpolated_across_the_wrap_of_the_yaw():
    buffer = PoseBuffer()
    buffer.odometry.add(SECOND, Pose(0.0, 0.0, 3.1))
    buffer.odometry.add(2 * SECOND, Pose(1.0, 0.0, -3.1))
    assert buffer.pose_at(SECOND) is None  # not yet in a map
    buffer.correction.add(SECOND, Pose(5.0, 0.0, 0.0))
    middle = buffer.pose_at(3 * SECOND // 2)
    assert middle is not None
    assert (middle.x, abs(middle.yaw)) == pytest.approx((5.5, math.pi))
    latest = buffer.latest()
    assert latest is not None
    assert (latest.x, latest.yaw) == pytest.approx((6.0, -3.1))
    assert buffer.pose_at(0) is None
    assert buffer.pose_at(3 * SECOND) is None


def test_a_stamp_that_falls_back_is_ignored_and_old_poses_are_forgotten():
    track = Trajectory()
    for second in range(60):
        track.add(second * SECOND, Pose(float(second), 0.0, 0.0))
    track.add(10 * SECOND, Pose(-1.0, 0.0, 0.0))
    assert track.at(59 * SECOND).x == 59.0
    assert track.at(55 * SECOND).x == 55.0
    assert not track.covers(10 * SECOND)


def test_a_scan_of_a_turning_robot_lies_on_the_walls_once_deskewed():
    world = MazeWorld(HALL, Pose(1.2, 0.9, 0.3), seed=1, odometry_at=Pose(0.0, 0.0, 0.0))
    track, misfit = Trajectory(), {}
    for _ in range(40):
        batch = world.step(Twist(0.2, 1.8))
        for odometry in batch.odometry:
            track.add(odometry.stamp, odometry.pose)
        for scan in batch.scans:
            for name, used in (("deskewed", scan), ("rigid", replace(scan, time_increment=0.0))):
                points = deskew(used, track, -0.032)
                ends, _ = points.placed(world.pose)
                away = np.minimum.reduce(
                    [
                        np.abs(ends[:, 0]),
                        np.abs(ends[:, 0] - 3),
                        np.abs(ends[:, 1]),
                        np.abs(ends[:, 1] - 2),
                    ]
                )
                misfit[name] = float(np.sqrt(np.mean(np.square(away))))
    assert misfit["deskewed"] < 0.03
    assert misfit["rigid"] > 2 * misfit["deskewed"]


def test_rays_that_did_not_come_back_are_left_out():
    odd = [1.0, 0.0, math.nan, math.inf, -math.inf, -1.0, 0.1, 9.0, 2.0]
    points = deskew(scan_of(odd), standing(), 0.0)
    assert np.hypot(*points.ends.T) == pytest.approx([1.0, 2.0])
    empty = deskew(scan_of([math.nan] * 5), standing(), 0.0)
    assert empty.ends.shape == empty.origins.shape == (0, 2)
    assert len(deskew(scan_of([]), standing(), 0.0).ends) == 0


def test_either_range_of_angles_and_any_number_of_rays_give_the_same_points():
    count = 36
    increment = 2 * math.pi / count
    angles = np.arange(count) * increment
    ranges = 1.0 + 0.1 * np.cos(angles)
    from_zero = deskew(scan_of(list(ranges), 0.0, increment), standing(), 0.0).ends
    turned = np.roll(ranges, count // 2)
    around = deskew(scan_of(list(turned), -math.pi, increment), standing(), 0.0).ends
    assert np.roll(around, -count // 2, axis=0) == pytest.approx(from_zero, abs=1e-6)
    doubled = [*ranges, ranges[0]]
    last = deskew(scan_of(doubled, 0.0, increment), standing(), 0.0).ends
    assert last[-1] == pytest.approx(last[0], abs=1e-6)


def test_the_last_ray_is_later_than_the_first():
    assert last_ray(scan_of([1.0] * 101)) == SECOND // 10


def imu(stamp: int, pitch: float, orientation: bool = True, rate: float = 0.0) -> Imu:
    """One sample at rest."""
    gravity = (-9.8 * math.sin(pitch), 0.0, 9.8 * math.cos(pitch))
    turned = quaternion_from_pose(Pose(0.0, 0.0, 0.4, pitch)) if orientation else None
    return Imu(stamp, turned, (0.0, rate, 0.0), gravity)


@pytest.mark.parametrize("orientation", [True, False])
def test_tilt_is_told_from_how_the_robot_stood(orientation):
    meter = TiltMeter()
    stance, slope, steps = 0.02, 0.119, 50
    for index in range(100):
        meter.add(imu(index * SECOND // 100, stance, orientation))
    meter.set_level(0, SECOND)
    assert meter.tilt(SECOND // 2, SECOND) == pytest.approx(0.0, abs=1e-6)
    rate = slope / (steps / 100)
    for index in range(1, steps + 1):
        pitch = stance + slope * index / steps
        meter.add(imu(SECOND + index * SECOND // 100, pitch, orientation, rate))
    now = SECOND + steps * SECOND // 100
    assert meter.tilt(now - SECOND // 100, now) == pytest.approx(slope, abs=0.01)
    assert meter.tilt(9 * SECOND, 10 * SECOND) == 0.0  # no sample tells


def test_an_orientation_of_zeros_is_none():
    meter = TiltMeter()
    meter.add(replace(imu(0, 0.1), orientation=(0.0, 0.0, 0.0, 0.0)))
    assert meter.tilt(0, 1) == pytest.approx(0.1)


def test_odometry_goes_on_over_a_jump_and_loses_the_gyros_bias():
    track = Trajectory()
    reckoning = DeadReckoning(track)

    def say(index: int, pose: Pose) -> Pose:
        reckoning.add(WheelOdometry(index * SECOND, pose, Twist()))
        return track.at(index * SECOND)

    say(0, Pose(1e9, -1e9, 2.0))
    assert say(1, Pose(1e9, -1e9, 2.01)).yaw == pytest.approx(0.01)
    reckoning.stood(0.01, 1.0)
    assert say(2, Pose(1e9, -1e9, 2.02)).yaw == pytest.approx(0.01)
    before = track.at(2 * SECOND)
    assert say(3, Pose(0.0, 0.0, 0.0)) == before
    assert reckoning.jumps == 1
    after = say(4, Pose(0.1, 0.0, 0.01))
    moved = compose(inverse(before), after)
    assert (moved.x, wrap_angle(moved.yaw)) == pytest.approx((0.1, 0.0), abs=1e-9)
    assert reckoning.odom_in(Pose(1.0, 0.0, 0.0)) == compose(
        Pose(1.0, 0.0, 0.0), inverse(Pose(0.1, 0.0, 0.01))
    )
