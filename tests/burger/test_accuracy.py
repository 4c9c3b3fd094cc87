"""The covariances of odometry and inertial unit hold what the robots' drawn errors make of them."""

from __future__ import annotations

import numpy as np

from burger_simulator.sensors.accuracy import OdometryAccuracy, imu_covariance
from burger_simulator.simulation import BurgerSimulation
from burger_simulator.world.generator import generate_maze
from rover_common.covariance import UNMEASURED
from rover_common.geometry import Pose, wrap_angle
from rover_common.sensor_types import Twist, WheelOdometry

ROBOTS = range(8)
SECONDS = 10
PLANAR = [0, 1, 5]  # x, y, yaw
# Of a chi-squared distribution of three degrees, 99.9 % lie below 16.3.
FAR = 16.3


def error_of(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """x, y, yaw of the odometry's error at the end of a drive, and its covariance (3, 3)."""
    simulation = BurgerSimulation(generate_maze(seed, "large"), seed)
    accuracy, start = OdometryAccuracy(), simulation.truth.pose
    covariance, last = np.eye(6), None
    for _ in range(20 * SECONDS):
        for each in simulation.step(Twist(0.03, 0.4)).odometry:  # in a small circle
            covariance, last = accuracy.follow(each).pose, each
    assert last is not None
    assert simulation.truth.contacts == 0
    return _difference(start, simulation.truth.pose, last), covariance[np.ix_(PLANAR, PLANAR)]


def _difference(start: Pose, end: Pose, odometry: WheelOdometry) -> np.ndarray:
    cos, sin = np.cos(-start.yaw), np.sin(-start.yaw)
    x, y = end.x - start.x, end.y - start.y
    true = np.array([cos * x - sin * y, sin * x + cos * y])
    yaw = wrap_angle(odometry.pose.yaw - wrap_angle(end.yaw - start.yaw))
    return np.array([odometry.pose.x - true[0], odometry.pose.y - true[1], yaw])


def test_the_errors_of_eight_robots_are_as_large_as_their_covariances_say():
    found = [error_of(seed) for seed in ROBOTS]
    distances = np.array([error @ np.linalg.solve(cov, error) for error, cov in found])
    assert (distances < FAR).mean() > 0.9
    assert distances.mean() > 0.3  # covariances far too large would hold anything


def test_the_pose_grows_less_certain_and_what_is_not_measured_says_so():
    accuracy = OdometryAccuracy()
    poses = [Pose(0.1 * second, 0.0, 0.0) for second in range(4)]
    given = [
        accuracy.follow(WheelOdometry(second * 10**9, pose, Twist(0.1, 0.0)))
        for second, pose in enumerate(poses)
    ]
    for axis in PLANAR:
        variances = [each.pose[axis, axis] for each in given]
        assert variances == sorted(variances)
        assert variances[-1] > variances[0]
    assert given[-1].pose[1, 5] > 0.0  # a heading that is off to the left is on the left, too
    assert given[-1].twist[2, 2] == UNMEASURED


def test_the_yaw_of_the_inertial_unit_drifts():
    early, late = imu_covariance(1.0), imu_covariance(60.0)
    assert late.orientation[2, 2] > early.orientation[2, 2] > 0.0
    assert (late.orientation[:2, :2] == early.orientation[:2, :2]).all()
    assert (late.angular_velocity == early.angular_velocity).all()
