"""Collects what the second robot's sensors say, message by message, to batches."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field, replace

from rover_common.sensor_types import Imu, LaserScan, SensorBatch, ThermalFrame, WheelOdometry

# Of a sensor, that wait while nobody takes them, as before a simulated clock begins. A tick counts
# no more than 255.
MOST = 1000


@dataclass(frozen=True)
class Tick:
    """The end of a batch, and how much belongs to it."""

    stamp: int  # [ns]
    scans: int = 0
    imus: int = 0
    odometry: int = 0
    thermal: tuple[int, int] = (0, 0)  # of sensor 1 and 2
    launches: int = 0  # reports of the launcher

    @classmethod
    def of(cls, batch: SensorBatch) -> Tick:
        sensors = [frame.sensor for frame in batch.thermal]
        return cls(
            batch.stamp,
            len(batch.scans),
            len(batch.imus),
            len(batch.odometry),
            (sensors.count(1), sensors.count(2)),
            batch.launches_done,
        )


@dataclass
class _Said:
    """What came since the last batch; of more than MOST the oldest is lost."""

    scans: deque[LaserScan] = field(default_factory=lambda: deque(maxlen=MOST))
    imus: deque[Imu] = field(default_factory=lambda: deque(maxlen=MOST))
    odometry: deque[WheelOdometry] = field(default_factory=lambda: deque(maxlen=MOST))
    thermal: deque[ThermalFrame] = field(default_factory=lambda: deque(maxlen=MOST))
    launches: int = 0

    def holds(self, tick: Tick, since: int) -> bool:
        """since: [ns] of the tick before. Once something newer is said, the tick is over."""
        imus = [imu.stamp for imu in self.imus if imu.stamp > since]
        odometry = [sample.stamp for sample in self.odometry if sample.stamp > since]
        sensors = [frame.sensor for frame in self.thermal]
        return (
            max(imus + odometry, default=tick.stamp) <= tick.stamp
            and len(imus) >= tick.imus
            and len(odometry) >= tick.odometry
            and len(self.scans) >= tick.scans
            and sensors.count(1) >= tick.thermal[0]
            and sensors.count(2) >= tick.thermal[1]
            and self.launches >= tick.launches
        )

    def until(self, stamp: int) -> _Said:
        """Only what was said of the time until `stamp` [ns]."""
        kept = _Said(thermal=self.thermal, launches=self.launches)
        kept.scans.extend(scan for scan in self.scans if scan.stamp <= stamp)
        kept.imus.extend(imu for imu in self.imus if imu.stamp <= stamp)
        kept.odometry.extend(sample for sample in self.odometry if sample.stamp <= stamp)
        return kept


class BatchCollector:
    """In lockstep a batch is complete when it has what its tick counts; nothing is told twice.

    A tick of which something was lost, as in a node that has just been started, is never complete:
    its samples come with the next tick, and do not count there.
    """

    def __init__(self) -> None:
        self._said = _Said()
        self._tick: Tick | None = None
        self._newest, self._since = -1, -1  # [ns] of the newest tick, and of the one before

    def add(self, said: LaserScan | Imu | WheelOdometry | ThermalFrame) -> None:
        if isinstance(said, LaserScan):
            self._said.scans.append(said)
        elif isinstance(said, Imu):
            self._said.imus.append(said)
        elif isinstance(said, WheelOdometry):
            self._said.odometry.append(said)
        else:
            self._said.thermal.append(said)

    def add_launch(self) -> None:
        """The launcher has reported the end of a sequence."""
        self._said.launches += 1

    def add_tick(self, tick: Tick) -> None:
        if tick.stamp < self._newest:  # the clock began anew
            self._newest, self._said = -1, self._said.until(tick.stamp)
        self._tick, self._since, self._newest = tick, self._newest, tick.stamp

    def take_complete(self) -> SensorBatch | None:
        """The batch of the last tick, once all of it is there; its frames arrived with it."""
        tick = self._tick
        if tick is None or not self._said.holds(tick, self._since):
            return None
        frames = [replace(frame, stamp=tick.stamp) for frame in self._said.thermal]
        self._said.thermal = deque(frames, maxlen=MOST)
        self._tick = None
        return self.take(tick.stamp)

    def take(self, stamp: int) -> SensorBatch:
        """All that came since the last batch, as one of `stamp` [ns]; for a robot without ticks."""
        said, self._said = self._said, _Said()
        return SensorBatch(
            stamp,
            tuple(said.scans),
            tuple(said.imus),
            tuple(said.odometry),
            tuple(sorted(said.thermal, key=lambda frame: frame.sensor)),
            said.launches,
        )
