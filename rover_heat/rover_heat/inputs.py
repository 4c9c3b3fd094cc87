"""Whether all inputs come, in time and by the same clock."""

from __future__ import annotations

import math

from rover_common.geometry import Pose, distance_between
from rover_heat.types import HeatFrame
from rover_navigation.localization.scan_points import last_ray
from rover_navigation.monitors import InputMonitor

# [s] without the input, after which the robot stops
SILENT = {"scan": 0.5, "imu": 0.3, "pose": 1.0}
JUMP = 0.3  # [m] of the pose between two scans
APART_WARNING, APART = 0.2, 0.5  # [s] between the inputs' stamps and the clock
APART_SECONDS = 1.0  # [s] for which they are apart before the robot stops


class InputWatch:
    """Ages by arrival, clocks by stamps; both at the tick at hand."""

    def __init__(self) -> None:
        self.poses = InputMonitor()  # between two scans
        self.jump = 0.0  # [m] at this tick
        self.distance = 0.0  # [m] driven
        self.apart = 0.0  # [s] between stamps and clock, now
        self._seen: dict[str, float] = {}  # [s] when each last came
        self._apart_since: float | None = None
        self._time = 0.0
        self._last: Pose | None = None
        self._pose_stamp = 0  # [ns]

    def update(self, frame: HeatFrame) -> None:
        """One tick."""
        self._time = time = frame.time
        arrived = {"scan": frame.scans, "imu": frame.imus}
        self._seen |= {name: time for name, came in arrived.items() if came}
        if frame.pose is not None:
            self._seen["pose"] = frame.pose_stamp * 1e-9
        self.jump = 0.0
        if frame.scans and frame.pose is not None:
            self.poses.update(time, frame.pose)
            self.jump = self.poses.jump
        if frame.pose is not None:
            if self._last is not None:
                self.distance += min(distance_between(self._last, frame.pose), JUMP)
            self._last = frame.pose
        self._compare_clocks(frame)

    @property
    def missing(self) -> tuple[str, ...]:
        """Inputs that are overdue."""
        return tuple(name for name in SILENT if self._overdue(name) > 0.0)

    @property
    def overdue(self) -> float:
        """[s] of the input that is longest overdue; 0 when all come."""
        return max(0.0, *(self._overdue(name) for name in SILENT))

    @property
    def clock_error(self) -> float:
        """[s] between stamps and clock, once it has lasted; else 0."""
        since = self._apart_since
        lasted = since is not None and self._time - since >= APART_SECONDS
        return self.apart if lasted else 0.0

    def _overdue(self, name: str) -> float:
        return self._time - self._seen.get(name, -math.inf) - SILENT[name]

    def _compare_clocks(self, frame: HeatFrame) -> None:
        stamps = [last_ray(scan) for scan in frame.scans[-1:]]
        stamps += [imu.stamp for imu in frame.imus[-1:]]
        if frame.pose_stamp != self._pose_stamp:
            self._pose_stamp = frame.pose_stamp
            stamps.append(frame.pose_stamp)
        if not stamps:
            return
        self.apart = max(abs(frame.stamp - stamp) for stamp in stamps) * 1e-9
        if self.apart <= APART:
            self._apart_since = None
        elif self._apart_since is None:
            self._apart_since = self._time
