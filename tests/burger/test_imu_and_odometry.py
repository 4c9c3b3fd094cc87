"""What inertial unit and odometry say, against the true motion."""

from __future__ import annotations

import numpy as np
import pytest
from sensor_runs import run, tilts
from worlds import ramp_ahead, square

from burger_simulator.options import BurgerOptions
from burger_simulator.simulation import BurgerSimulation
from burger_simulator.world.maze import SensorErrors
from rover_common.geometry import Pose, wrap_angle
from rover_common.sensor_types import Twist


def test_rates_and_stamps_of_imu_and_odometry():
    batches = run(BurgerSimulation(square()), 2.0)
    imu = [sample.stamp for batch in batches for sample in batch.imus]
    assert np.diff(imu).tolist() == [10_000_000] * 199
    odometry = [sample.stamp for batch in batches for sample in batch.odometry]
    assert len(odometry) == 60
    assert np.abs(np.diff(odometry) - 1e9 / 30).max() <= 5e6
    for batch in batches:
        everything = (*batch.scans, *batch.imus, *batch.odometry, *batch.thermal)
        assert all(sample.stamp <= batch.stamp for sample in everything)


def test_the_inertial_units_noise_and_bias():
    errors = SensorErrors(gyro_bias=(0.001, -0.002, 0.003))
    batches = run(BurgerSimulation(square(errors=errors), 3), 20.0)
    gyro = np.array([imu.angular_velocity for batch in batches for imu in batch.imus])
    acceleration = np.array([imu.linear_acceleration for batch in batches for imu in batch.imus])
    assert gyro.mean(axis=0) == pytest.approx([0.001, -0.002, 0.003], abs=3e-5)
    assert gyro.std(axis=0) == pytest.approx([2e-4] * 3, rel=0.1)
    assert acceleration.std(axis=0) == pytest.approx([0.017] * 3, rel=0.1)
    assert np.linalg.norm(acceleration.mean(axis=0)) == pytest.approx(9.81, abs=0.01)
    yaw = np.unwrap(tilts(batches)[:, 2])
    assert yaw[-1] == pytest.approx(0.003 * 20.0, rel=0.05)


def test_the_attitude_is_that_of_a_unit_mounted_out_of_level():
    errors = SensorErrors(level_pitch=0.02, level_roll=-0.01)
    simulation = BurgerSimulation(square(errors=errors), 3)
    roll, pitch, _ = tilts(run(simulation, 5.0)).mean(axis=0)
    assert pitch == pytest.approx(simulation.truth.pose.pitch + 0.02, abs=0.002)
    assert roll == pytest.approx(-0.01, abs=0.002)


def test_the_attitude_follows_the_ramp_and_the_heading():
    simulation = BurgerSimulation(square(2.0, ramp=ramp_ahead(0.3)), 1)
    while simulation.truth.beyond_foot < 0.2:
        batch = simulation.step(Twist(0.15))
    assert tilts([batch])[-1, 1] == pytest.approx(simulation.truth.pose.pitch, abs=0.015)
    turning = BurgerSimulation(square(start=Pose(0.0, 0.0, 0.7)), 1)
    batch = run(turning, 3.0, Twist(0.0, 1.0))[-1]
    expected = wrap_angle(turning.truth.pose.yaw - 0.7)
    assert tilts([batch])[-1, 2] == pytest.approx(expected, abs=0.01)


def test_an_acceleration_tilts_the_attitude_for_a_while():
    simulation = BurgerSimulation(square(5.0), 1)
    level = tilts(run(simulation, 2.0))[:, 1].mean()
    start = tilts(run(simulation, 0.3, Twist(0.2)))[:, 1]
    assert 0.01 < np.abs(start - level).max() < 0.2 * 0.3
    cruise = tilts(run(simulation, 2.0, Twist(0.2)))[-50:, 1]
    assert np.abs(cruise - level).max() < 0.01


def test_odometry_follows_the_path_with_the_gyros_heading():
    errors = SensorErrors(gyro_bias=(0.0, 0.0, 0.01), wheel_radius_scale=0.995)
    start = Pose(-3.0, 0.0, 0.0)
    simulation = BurgerSimulation(square(5.0, start=start, errors=errors), 1)
    last = run(simulation, 20.0, Twist(0.2))[-1].odometry[-1]
    truth = simulation.truth.pose
    assert last.pose.x == pytest.approx((truth.x + 3.0) / 0.995, rel=0.01)
    assert last.pose.yaw == pytest.approx(0.01 * 20.0, rel=0.05)
    assert last.pose.y == pytest.approx(0.5 * 0.01 * 20.0**2 * 0.2, rel=0.1)
    assert last.twist.linear == pytest.approx(0.2, rel=0.02)
    assert last.twist.angular == pytest.approx(0.01, abs=0.01)


def test_odometry_may_begin_anywhere():
    simulation = BurgerSimulation(square(), options=BurgerOptions(odometry_x=1.0e9))
    assert run(simulation, 0.5)[-1].odometry[-1].pose.x == pytest.approx(1.0e9, abs=0.01)
