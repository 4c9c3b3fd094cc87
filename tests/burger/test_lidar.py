"""What the lidar says, against where the walls are."""

from __future__ import annotations

import numpy as np
import pytest
from sensor_runs import run, scans
from worlds import ramp_ahead, square

from burger_simulator.options import BurgerOptions
from burger_simulator.sensors import lidar
from burger_simulator.simulation import BurgerSimulation
from rover_common.geometry import Pose
from rover_common.sensor_types import Twist


def square_ranges(bearings: np.ndarray, half: float, x: float) -> np.ndarray:
    """From (x, 0) to the faces of a square around the origin."""
    face = half - 0.0025
    cos, sin = np.cos(bearings), np.sin(bearings)
    to_x = (np.where(cos > 0, face, -face) - x) / np.where(cos == 0, 1e-12, cos)
    to_y = face / np.maximum(np.abs(sin), 1e-12)
    return np.minimum(to_x, to_y)


def test_a_scan_shows_the_walls_with_the_sensors_errors():
    errors = []
    for scan in scans(run(BurgerSimulation(square(1.5), 1), 20.0)):
        assert len(scan.ranges) == 230
        assert (scan.range_min, scan.range_max) == pytest.approx((0.16, 8.0))
        bearings = scan.angle_min + scan.angle_increment * np.arange(230)
        errors.append(scan.ranges - square_ranges(bearings, 1.5, -0.032))
    lost = np.array(errors) < -0.5
    assert np.mean(lost) == pytest.approx(0.01, abs=0.002)
    kept = np.ma.masked_array(errors, lost)
    expected = 0.005 + 0.01 * square_ranges(np.linspace(0, 2 * np.pi, 230, False), 1.5, -0.032)
    assert np.ma.std(kept / expected) == pytest.approx(1.0, abs=0.03)
    assert abs(kept.mean()) < 0.002


def test_what_is_out_of_reach_reads_zero():
    near_and_far = square(9.0, start=Pose(-8.84, 0.0, 0.0))
    (scan, *_) = scans(run(BurgerSimulation(near_and_far, 1), 0.5))
    assert scan.ranges[115] == 0.0  # 0.13 m
    assert scan.ranges[0] == 0.0  # 17.9 m
    assert (scan.ranges > 0.0).sum() > 20
    assert scan.ranges[scan.ranges > 0.0].min() >= 0.16


def test_a_turning_robots_scan_is_skewed_as_its_times_say(monkeypatch):
    """Undone by the true heading at each ray's time, walls are where they are."""
    monkeypatch.setattr(lidar, "SIGMA", 0.0)
    monkeypatch.setattr(lidar, "SIGMA_SHARE", 0.0)
    simulation = BurgerSimulation(square(1.5), 1)
    run(simulation, 1.0, Twist(0.0, 1.8))
    times, headings, found = [], [], []
    for _ in range(40):
        batch = simulation.step(Twist(0.0, 1.8))
        times.append(simulation.time)
        headings.append(simulation.truth.pose.yaw)
        found += batch.scans
    unwrapped = np.unwrap(headings)
    worst = []
    for scan in found[2:]:
        at = scan.stamp / 1e9 + scan.time_increment * np.arange(230)
        bearings = np.interp(at, times, unwrapped) + scan.angle_increment * np.arange(230)
        ranges = np.where(scan.ranges > 0, scan.ranges, np.nan)
        centre = -0.032 * np.exp(1j * np.interp(at, times, unwrapped))
        points = centre + ranges * np.exp(1j * bearings)
        off = np.maximum(np.abs(points.real), np.abs(points.imag)) - 1.4975
        worst.append(np.nanstd(off))
    assert np.mean(worst) < 0.003
    assert found[0].time_increment == pytest.approx(0.1 / 230)


def test_scans_come_in_their_order_and_half_as_often_with_twice_the_rays():
    stamps = [scan.stamp for scan in scans(run(BurgerSimulation(square()), 2.0))]
    assert np.diff(stamps).tolist() == [100_000_000] * 19
    assert stamps[0] == 1_000_000_000
    slow = scans(run(BurgerSimulation(square(), options=BurgerOptions(scan_rate=5.0)), 2.0))
    assert np.diff([scan.stamp for scan in slow]).tolist() == [200_000_000] * 9
    assert {len(scan.ranges) for scan in slow} == {460}


def test_a_lidar_on_the_slope_sees_the_floor_behind_it():
    simulation = BurgerSimulation(square(3.0, ramp=ramp_ahead(0.3)))
    (before,) = scans(run(simulation, 0.1))
    while simulation.truth.beyond_foot < 0.3:
        simulation.step(Twist(0.15))
    run(simulation, 1.0)
    after = scans(run(simulation, 1.0))
    behind = np.median([scan.ranges[115] for scan in after])
    assert before.ranges[115] > 2.0 or before.ranges[115] == 0.0
    assert behind < 1.8
    assert np.median([scan.ranges[57] for scan in after]) == pytest.approx(3.0, abs=0.1)
