"""What is kept of the run at hand, so that a late viewer sees it from the beginning.

The rover's track, the plots' samples and the timeline of states. All begin anew with another run.
Times are seconds of frame time since the run's first telemetry.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rover_common.types import Run, VehicleState
from rover_dashboard.log import Cursor, Log, News, every_second, newer_half

PERIOD = 0.5  # [s] of frame time between two samples of the plots
TRACK_POINTS, SAMPLES, STATES = 4096, 2048, 512  # kept at most
PENDING = 64  # frames whose command may still come
LOGS = ("track", "plots", "timeline")


@dataclass(frozen=True)
class StateReport:
    """The mission's state as it was reported."""

    stamp: int  # [ns]
    run: int
    name: str
    reason: str


class History:
    """Fed by the ROS thread, read by the server's."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._logs = {
            "track": Log(TRACK_POINTS, every_second),
            "plots": Log(SAMPLES, every_second),
            "timeline": Log(STATES, newer_half),
        }
        self.run: Run | None = None
        self._early: StateReport | None = None  # of a run whose first frame has not come yet
        self._map_stamp: int | None = None  # [ns]
        self._arrivals: dict[int, float] = {}  # [s] by stamp [ns] of the newest frames
        self._begin_samples()

    def since(self, name: str, cursor: Cursor) -> News | None:
        """The rows of a log that a viewer does not have yet."""
        with self._lock:
            return self._logs[name].since(cursor)

    def add_frame(
        self, vehicle: VehicleState, readings: Sequence[float | None], spacing: float
    ) -> bool:
        """One frame; whether a run begins with it.

        readings: what is plotted beside the speed; spacing [m]: between two points of the track.
        """
        with self._lock:
            begins = vehicle.run != self.run
            if begins:
                self._begin(vehicle.run)
            self._arrivals[vehicle.stamp] = self._clock()
            if len(self._arrivals) > PENDING:
                del self._arrivals[next(iter(self._arrivals))]
            self._add_point(vehicle, spacing)
            self._add_sample(vehicle, readings)
            return begins

    def add_command(self, frame_stamp: int) -> None:
        """The command for a frame [ns] has come."""
        with self._lock:
            arrived = self._arrivals.pop(frame_stamp, None)
            if arrived is not None:
                self._latencies.append(self._clock() - arrived)

    def add_map(self, stamp: int) -> None:
        """A map that holds all frames up to a stamp [ns]."""
        with self._lock:
            self._map_stamp = stamp

    def add_state(self, report: StateReport) -> None:
        """Kept when the state is another than before."""
        with self._lock:
            if self.run is None or report.run != self.run.number:
                self._early = report
                return
            self._early = None
            timeline = self._logs["timeline"]
            if timeline.last is None or timeline.last[1] != report.name:
                timeline.append((self._elapsed(report.stamp), report.name, report.reason))

    def restart(self) -> None:
        """Forget everything, as before the first frame."""
        with self._lock:
            self._clear()
            self.run = self._early = None

    def stop_viewing(self) -> None:
        """Nobody looks: maps and commands are no longer heard of."""
        with self._lock:
            self._map_stamp = None
            self._arrivals.clear()

    def _begin(self, run: Run) -> None:
        self._clear()
        self.run = run
        early = self._early
        if early is not None and early.run == run.number:
            self._logs["timeline"].append((self._elapsed(early.stamp), early.name, early.reason))
            self._early = None

    def _clear(self) -> None:
        for log in self._logs.values():
            log.clear()
        self._arrivals.clear()
        self._map_stamp = None
        self._begin_samples()

    def _begin_samples(self) -> None:
        self._period = PERIOD
        self._due = -math.inf  # [s] the next sample
        self._frames = 0  # since the last sample, which was taken
        self._sampled: float | None = None  # [s] then
        self._latencies: list[float] = []  # [s] since then

    def _elapsed(self, stamp: int) -> float:
        assert self.run is not None
        return round((stamp - self.run.start) * 1e-9, 2)

    def _add_point(self, vehicle: VehicleState, spacing: float) -> None:
        point = (round(vehicle.pose.x, 3), round(vehicle.pose.y, 3))
        track = self._logs["track"]
        if track.last is None or math.dist(track.last, point) >= spacing:
            track.append(point)

    def _add_sample(self, vehicle: VehicleState, readings: Sequence[float | None]) -> None:
        self._frames += 1
        elapsed = self._elapsed(vehicle.stamp)
        if elapsed < self._due:
            return
        now = self._clock()
        latencies = self._latencies
        seconds = 0.0 if self._sampled is None else now - self._sampled
        row = (
            elapsed,
            round(vehicle.speed, 2),
            *readings,
            round(self._frames / seconds, 1) if seconds > 0.0 else None,
            round(1e3 * sum(latencies) / len(latencies), 2) if latencies else None,
            None if self._map_stamp is None else round((vehicle.stamp - self._map_stamp) * 1e-9, 2),
        )
        if self._logs["plots"].append(row):
            self._period *= 2
        self._due = elapsed + self._period
        self._frames, self._sampled, self._latencies = 0, now, []
