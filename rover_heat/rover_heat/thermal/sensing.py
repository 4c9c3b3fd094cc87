"""What the thermal sensors have found so far: fixes, and faces that were examined."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, wrap_angle
from rover_common.saved_state import Memory
from rover_common.sensor_types import ThermalFrame
from rover_heat.config import HeatConfig, thermal_flip, thermal_yaw
from rover_heat.thermal.coverage import Coverage, Examined
from rover_heat.thermal.detection import WarmPatch, find_patch
from rover_heat.thermal.fix import Fix, View, arrays_of, fixes_of, make_fix
from rover_heat.thermal.scan_hits import ScanHits
from rover_heat.thermal.stuck_pixels import StuckPixels
from rover_heat.thermal.validation import ThermalFrameError, valid_celsius
from rover_heat.tilt import TiltMonitor
from rover_heat.types import HeatFrame

SENSORS = (1, 2)
SILENT = 3.0  # [s] without a frame, after which a sensor counts as dead
AIR_SPAN = 6.0  # [K] from the air, within which a frame's median is plausible
Columns = NDArray[np.float64]  # (8,) [K] the hottest of each column above the frame's median
AIR_FRAMES = 20  # at first, whose median is the air
MOST_FIXES = 1200  # kept; then every second of the older half goes


@dataclass
class _Sensor:
    """One of the two."""

    frames: int = 0  # that were valid
    last: float = -math.inf  # [s] when the newest came
    period: float = 0.1  # [s] between the last two
    warm_in_row: int = 0
    patch: WarmPatch | None = None  # of the newest frame
    stuck: StuckPixels = field(default_factory=StuckPixels)
    medians: list[float] = field(default_factory=list)  # [C] of the first frames


class ThermalSensing:
    """Takes every frame once."""

    def __init__(self, config: HeatConfig, tilt: TiltMonitor) -> None:
        self._config = config
        self._tilt = tilt
        self._sensors = {sensor: _Sensor() for sensor in SENSORS}
        self._yaw = 0.0  # [rad] of the robot, not wrapped
        self._time = 0.0
        self.scans = ScanHits()
        self.coverage = Coverage(config)
        self.fixes: list[Fix] = []
        self.views: list[tuple[View, Columns]] = []  # of this tick, that were fit
        self.dropped: Counter[str] = Counter()  # frames, by reason

    def memory(self) -> dict[str, Any]:
        """Of the sensors themselves, for JSON."""
        return {
            str(number): {"medians": list(sensor.medians), "stuck": sensor.stuck.memory()}
            for number, sensor in self._sensors.items()
        }

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        for number, sensor in self._sensors.items():
            own = memory[str(number)]
            sensor.medians = [float(median) for median in own["medians"]]
            sensor.stuck.restore(own["stuck"])

    def places(self) -> Memory:
        """What was found where."""
        examined = self.coverage.snapshot()
        cells: dict[str, NDArray[Any]] = {"keys": examined.keys, "sectors": examined.sectors}
        return {}, arrays_of(self.fixes) | cells

    def restore_places(self, memory: Memory) -> None:
        """Take what `places` gave; raises ValueError or KeyError for anything else."""
        arrays = memory[1]
        self.fixes = fixes_of(arrays)
        self.coverage.restore(Examined(arrays["keys"], arrays["sectors"]))

    def update(self, frame: HeatFrame) -> None:
        """One tick."""
        self._time = frame.time
        self.views = []
        self.scans.update(frame.scans, frame.poses)
        for thermal in frame.thermal:
            if thermal.sensor in self._sensors:
                self._take(thermal, frame)

    @property
    def alive(self) -> tuple[int, ...]:
        """Sensors that say something."""
        return tuple(
            number for number, sensor in self._sensors.items() if self._time - sensor.last < SILENT
        )

    @property
    def period(self) -> float:
        """[s] Between two frames of a sensor that is alive, the slowest of them."""
        return max((self._sensors[number].period for number in self.alive), default=0.1)

    @property
    def is_warm(self) -> bool:
        """Whether the newest frame of a sensor shows heat."""
        return any(self._sensors[number].patch is not None for number in self.alive)

    def bearing(self, sensor: int) -> float | None:
        """[rad] In base_footprint, of what is warm in a sensor's newest frame."""
        patch = self._sensors[sensor].patch
        if patch is None or patch.cut or sensor not in self.alive:
            return None
        return thermal_yaw(self._config, sensor) + patch.azimuth

    def forget_since(self, time: float) -> None:
        """Drop the fixes that were made since a time [s]."""
        self.fixes = [fix for fix in self.fixes if fix.stamp * 1e-9 < time]

    def forget_near(self, x: float, y: float, distance: float) -> None:
        """Drop the fixes within a distance [m] of a place."""
        self.fixes = [fix for fix in self.fixes if math.dist((fix.x, fix.y), (x, y)) > distance]

    def _take(self, thermal: ThermalFrame, frame: HeatFrame) -> None:
        sensor = self._sensors[thermal.sensor]
        try:
            celsius = valid_celsius(thermal.celsius, thermal_flip(self._config, thermal.sensor))
        except ThermalFrameError as error:
            self.dropped[str(error)] += 1
            return
        if sensor.frames:
            sensor.period = min(frame.time - sensor.last, SILENT)
        sensor.frames, sensor.last = sensor.frames + 1, frame.time
        stamp = thermal.stamp - round(self._config.thermal_delay * 1e9)
        pose = frame.poses.pose_at(stamp)
        celsius = sensor.stuck.mended(celsius)
        sensor.patch = find_patch(celsius, self._config)
        columns = celsius.max(axis=0) - np.median(celsius)
        fit = self._in_air(sensor, float(np.median(celsius))) and self._tilt.fit(stamp)
        if pose is None:
            sensor.warm_in_row = 0
            return
        self._watch_pixels(thermal.sensor, sensor, pose)
        sensor.warm_in_row = sensor.warm_in_row + 1 if fit and sensor.patch is not None else 0
        if fit:
            self._look(sensor, columns, View(
                stamp, thermal.sensor, pose, frame.twist.linear, self._tilt.turn_rate(stamp),
                self.scans.near(stamp),
            ))  # fmt: skip

    def _look(self, sensor: _Sensor, columns: Columns, view: View) -> None:
        """A frame that is fit: the fix when it is the second that is warm, and what it examines.

        A frame that is warm without telling where examines nothing: the walls in it stay open, and
        the robot comes to look at them from another place.
        """
        self.views.append((view, columns))
        fix = None
        if sensor.patch is not None and sensor.warm_in_row >= 2:
            fix = make_fix(sensor.patch, view, self._config)
        if fix is not None and (fix.sharp or self._config.heat_bearing == "axis"):
            self.fixes.append(fix)
        if sensor.patch is None or fix is not None:
            self.coverage.update(view, sensor.frames)
        if len(self.fixes) > MOST_FIXES:
            half = MOST_FIXES // 2
            self.fixes = self.fixes[:half:2] + self.fixes[half:]

    def _watch_pixels(self, number: int, sensor: _Sensor, pose: Pose) -> None:
        """Fixes of a pixel that proves to be stuck were none."""
        self._yaw += wrap_angle(pose.yaw - self._yaw)
        patch = sensor.patch
        if patch is not None and sensor.stuck.update(patch, self._yaw):
            mine = (number, patch.pixel)
            self.fixes = [fix for fix in self.fixes if (fix.sensor, fix.pixel) != mine]
            sensor.patch = None
        elif patch is None:
            sensor.stuck.update(None, self._yaw)

    @staticmethod
    def _in_air(sensor: _Sensor, median: float) -> bool:
        """Whether a frame's median [C] is near to that of the first ones."""
        if len(sensor.medians) < AIR_FRAMES:
            sensor.medians.append(median)
        return abs(median - float(np.median(sensor.medians))) <= AIR_SPAN
