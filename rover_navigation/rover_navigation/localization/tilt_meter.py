"""How far the robot leans from the way it stood at the start."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from rover_common.geometry import angles_from_quaternion
from rover_common.saved_state import Memory
from rover_common.sensor_types import Imu

SAMPLES = 400  # kept: some seconds at 100 Hz
SETTLING = 1.0  # [s] in which the accelerometer corrects the gyro, where no orientation is measured


class TiltMeter:
    """Roll and pitch by stamp: the sensor's own, else from gyro and accelerometer."""

    def __init__(self) -> None:
        self._samples: deque[tuple[int, float, float]] = deque(maxlen=SAMPLES)
        self.level = (0.0, 0.0)  # [rad] roll, pitch

    def memory(self) -> Memory:
        """Level, and the samples that it is told from."""
        stamps = np.array([sample[0] for sample in self._samples], np.int64)
        angles = np.array([sample[1:] for sample in self._samples], float).reshape(-1, 2)
        return {"level": list(self.level)}, {"stamps": stamps, "angles": angles}

    def restore(self, memory: Memory) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        values, arrays = memory
        roll, pitch = values["level"]
        stamps, angles = arrays["stamps"].tolist(), arrays["angles"].tolist()
        samples = [(at, *each) for at, each in zip(stamps, angles, strict=True)]
        self.level = float(roll), float(pitch)
        self._samples = deque(((at, roll, pitch) for at, roll, pitch in samples), SAMPLES)

    def add(self, imu: Imu) -> tuple[float, float] | None:
        """Roll and pitch [rad] as measured by one sample; None for one that is not a number."""
        if not all(map(math.isfinite, (*imu.angular_velocity, *imu.linear_acceleration))):
            return None
        if imu.orientation is not None and _is_rotation(imu.orientation):
            roll, pitch, _ = angles_from_quaternion(*imu.orientation)
        else:
            roll, pitch = self._filtered(imu)
        self._samples.append((imu.stamp, roll, pitch))
        return roll, pitch

    def _filtered(self, imu: Imu) -> tuple[float, float]:
        """Complementary filter: the gyro's fast changes on the accelerometer's mean."""
        x, y, z = imu.linear_acceleration
        roll, pitch = math.atan2(y, z), math.atan2(-x, math.hypot(y, z))
        if not self._samples:
            return roll, pitch
        stamp, last_roll, last_pitch = self._samples[-1]
        seconds = (imu.stamp - stamp) / 1e9
        share = seconds / (seconds + SETTLING)
        roll_rate, pitch_rate, _ = imu.angular_velocity
        last_roll += roll_rate * seconds
        last_pitch += pitch_rate * seconds
        return last_roll + share * (roll - last_roll), last_pitch + share * (pitch - last_pitch)

    def set_level(self, first: int, last: int) -> None:
        """From here on level is how the robot stood between two stamps [ns]."""
        self.level = self._mean(first, last) or self.level

    def lean(self, first: int, last: int) -> tuple[float, float]:
        """Roll and pitch [rad] from level, means between two stamps [ns]; 0 where none tells."""
        roll, pitch = self._mean(first, last) or self.level
        return roll - self.level[0], pitch - self.level[1]

    def tilt(self, first: int, last: int) -> float:
        """[rad] from level, the mean between two stamps [ns]; 0 where no sample tells."""
        return math.hypot(*self.lean(first, last))

    def _mean(self, first: int, last: int) -> tuple[float, float] | None:
        inside = [sample[1:] for sample in self._samples if first <= sample[0] <= last]
        if not inside:
            return None
        roll, pitch = np.mean(inside, axis=0)
        return float(roll), float(pitch)


def _is_rotation(quaternion: tuple[float, float, float, float]) -> bool:
    """Whether an orientation was measured: sensors without one send zeros."""
    return abs(math.hypot(*quaternion) - 1.0) < 0.1
