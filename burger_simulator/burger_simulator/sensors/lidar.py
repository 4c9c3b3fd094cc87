"""The LDS-02 lidar: 2300 rays a second, one after the other, while the robot moves."""

from __future__ import annotations

import math

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from burger_simulator.model.physics import Physics
from rover_common.burger import BURGER
from rover_common.sensor_types import LaserScan

SAMPLES = 2300  # [1/s] by the maker's sheet
PART = 0.01  # [s] of a turn whose rays are cast from one position
PART_RAYS = round(SAMPLES * PART)
SIGMA, SIGMA_SHARE = 0.005, 0.01  # [m] and of the range
REACH = 1.1 * BURGER.lidar_range_max  # [m] cast further than noise brings back
LOST = 0.01  # share of the rays that come back as 0
MOUNTING = np.array([BURGER.lidar_x, 0.0, BURGER.lidar_z])  # [m] in base_footprint


class Lidar:
    """Rays turn left, the first of a turn is straight ahead."""

    def __init__(self, physics: Physics, rate: float, random: Generator) -> None:
        """rate [1/s]: turns; a slower turn has more rays."""
        self._physics, self._random = physics, random
        self._parts = round(1.0 / (rate * PART))
        self._increment = 2.0 * math.pi / (self._parts * PART_RAYS)
        self._distances: list[NDArray[np.float64]] = []  # of the turn's parts so far
        self._directions = np.zeros((PART_RAYS, 3))
        # [s] of a part's rays from the middle of the part, where the robot is when they are cast
        self._times = (np.arange(PART_RAYS) / PART_RAYS - 0.5) * PART

    def measure_part(self, stamp: int) -> LaserScan | None:
        """In the middle of a part, at `stamp` [ns]; the scan when it was the turn's last one."""
        first = len(self._distances) * PART_RAYS
        angles = np.arange(first, first + PART_RAYS) * self._increment
        angles += self._times * self._physics.turn_rate
        np.cos(angles, out=self._directions[:, 0])
        np.sin(angles, out=self._directions[:, 1])
        rotation = self._physics.rotation
        origin = self._physics.position + rotation @ MOUNTING
        self._distances.append(self._physics.cast(origin, self._directions @ rotation.T, REACH))
        if len(self._distances) < self._parts:
            return None
        ranges = self._noisy(np.concatenate(self._distances))
        self._distances = []
        half_part = round(PART / 2 * 1e9)
        return LaserScan(
            stamp=stamp + half_part - round(self._parts * PART * 1e9),
            angle_min=0.0,
            angle_increment=float(np.float32(self._increment)),  # as the message has it
            time_increment=float(np.float32(1.0 / SAMPLES)),
            range_min=float(np.float32(BURGER.lidar_range_min)),
            range_max=BURGER.lidar_range_max,
            ranges=ranges,
        )

    def _noisy(self, distances: NDArray[np.float64]) -> NDArray[np.float32]:
        """What is lost or out of reach reads 0, as from the device."""
        noise = self._random.standard_normal(len(distances))
        lost = self._random.random(len(distances)) < LOST
        ranges = distances + noise * (SIGMA + SIGMA_SHARE * distances)
        valid = (ranges >= BURGER.lidar_range_min) & (ranges <= BURGER.lidar_range_max) & ~lost
        return np.where(valid, ranges, 0.0).astype(np.float32)
