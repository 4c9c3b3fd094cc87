"""Runs of the simulation, and what the sensors said in them."""

from __future__ import annotations

import numpy as np

from burger_simulator.simulation import BurgerSimulation
from rover_common.geometry import angles_from_quaternion
from rover_common.sensor_types import LaserScan, SensorBatch, Twist

STILL = Twist()


def run(simulation: BurgerSimulation, seconds: float, twist: Twist = STILL) -> list[SensorBatch]:
    return [simulation.step(twist) for _ in range(round(seconds / 0.05))]


def scans(batches: list[SensorBatch]) -> list[LaserScan]:
    return [scan for batch in batches for scan in batch.scans]


def frames(batches: list[SensorBatch], sensor: int) -> np.ndarray:
    return np.array([f.celsius for b in batches for f in b.thermal if f.sensor == sensor])


def tilts(batches: list[SensorBatch]) -> np.ndarray:
    """Roll, pitch, yaw [rad] of each sample."""
    return np.array([angles_from_quaternion(*imu.orientation) for b in batches for imu in b.imus])
