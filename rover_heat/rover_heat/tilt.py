"""When the robot tilts: three rules on the tilt from level, as one number."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from rover_common.sensor_types import Imu
from rover_heat.config import HeatConfig
from rover_navigation.localization.tilt_meter import TiltMeter

MEAN = 300_000_000  # [ns] single values reach 0.05 rad on flat ground, their mean 0.012
FIT_TILT, FIT_TURN = 0.05, 0.3  # [rad], [rad/s] within which a thermal frame is fit for a fix
# [ns] before a thermal frame in which the robot must not turn: the pixels' own delay, and what the
# arrival of a frame may be late by
FIT_SPAN = 400_000_000
REST = 2_000_000_000  # [ns] at rest that level is measured in
MOMENT = 100_000_000  # [ns]
KEPT = 2_000_000_000  # [ns] of turn rates


@dataclass(frozen=True)
class Lean:
    """From level, the mean of 0.3 s; signs as in a Pose."""

    roll: float = 0.0  # [rad]
    pitch: float = 0.0  # [rad]

    @property
    def slope(self) -> float:
        """[rad] Of the ground; a robot on a ramp's corner shares it between roll and pitch."""
        return math.hypot(self.roll, self.pitch)


class TiltMonitor:
    """Follows the inertial unit; level and gyro bias are measured at rest."""

    def __init__(self, config: HeatConfig) -> None:
        self._config = config
        self._meter = TiltMeter()
        self._rates: list[tuple[int, float]] = []  # [ns], [rad/s] of yaw
        self._bias = 0.0  # [rad/s]
        self._mean_pitch = 0.0  # [rad] of the absolute value, since the start
        self._count = 0
        self._newest = 0  # [ns]
        self.lean = Lean()
        self.share = 0.0  # of what the rules allow; more than 1 is a tilt
        self.measured = False  # what is level

    def memory(self) -> dict[str, Any]:
        """What was measured at rest, and the running mean, for JSON."""
        return {
            "measured": self.measured,
            "level": list(self._meter.level),
            "bias": self._bias,
            "mean_pitch": self._mean_pitch,
            "count": self._count,
        }

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        roll, pitch = memory["level"]
        self._meter.level = float(roll), float(pitch)
        self._bias, self.measured = float(memory["bias"]), bool(memory["measured"])
        self._mean_pitch, self._count = float(memory["mean_pitch"]), int(memory["count"])

    def update(self, imus: Iterable[Imu]) -> None:
        """What has come since the last tick; without any, all stays as it was."""
        sudden = 0.0
        for imu in imus:
            measured = self._meter.add(imu)
            if measured is None:
                continue
            self._newest = imu.stamp
            self._rates.append((imu.stamp, imu.angular_velocity[2]))
            roll, pitch = (a - b for a, b in zip(measured, self._meter.level, strict=True))
            absolute = max(abs(roll), abs(pitch)) / self._config.imu_abs_threshold
            sudden = max(sudden, absolute, self._share_of_running_mean(abs(measured[1])))
        self._rates = [(at, rate) for at, rate in self._rates if at > self._newest - KEPT]
        self.lean = Lean(*self._meter.lean(self._newest - MEAN, self._newest))
        if self.measured:
            self.share = max(self.lean.slope / self._config.ramp_rise, sudden)

    def set_level(self, stamp: int) -> None:
        """The robot has stood still up to a stamp [ns]: that is level, and no turn."""
        first = stamp - REST
        self._meter.set_level(first, stamp)
        rates = [rate for at, rate in self._rates if at >= first]
        self._bias = sum(rates) / len(rates) if rates else 0.0
        self.measured = True
        self.lean, self.share = Lean(), 0.0

    @property
    def turn_now(self) -> float:
        """[rad/s] How fast it turns, to either side, in the mean of the last moment."""
        rates = [rate - self._bias for at, rate in self._rates if at > self._newest - MOMENT]
        return abs(sum(rates) / len(rates)) if rates else 0.0

    def turn_rate(self, stamp: int) -> float:
        """[rad/s] The fastest turn in the time before a stamp [ns] that a thermal frame shows."""
        first = stamp - FIT_SPAN
        rates = [abs(rate - self._bias) for at, rate in self._rates if first <= at <= stamp]
        return max(rates, default=0.0)

    def fit(self, stamp: int) -> bool:
        """Whether a thermal frame taken at a stamp [ns] is fit for a fix."""
        roll, pitch = self._meter.lean(stamp - MEAN, stamp)
        return max(abs(roll), abs(pitch)) < FIT_TILT and self.turn_rate(stamp) < FIT_TURN

    def _share_of_running_mean(self, pitch: float) -> float:
        """The reference's rule: pitch [rad] as measured, against its own mean since the start."""
        self._count += 1
        self._mean_pitch += (pitch - self._mean_pitch) / self._count
        limit = self._config.imu_threshold * self._mean_pitch
        return pitch / limit if limit > 0.0 else 0.0
