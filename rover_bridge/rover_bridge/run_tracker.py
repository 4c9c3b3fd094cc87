"""When a run begins, and the stamps of its telemetries: the only place that decides it.

A simulator that is reset, reloaded or replaced begins a new run: its clock falls back, its rover
stands somewhere else, or samples that were collected are there again. So does a request.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.types import Run, Telemetry
from rover_common.vehicle import ROVER

# [s] by which the clock falls back. Within a run a simulator's clock never does; a wall clock that
# is set by the network falls back by less.
CLOCK_FELL_BACK = 0.5
# [m] beyond what the rover can have driven since the telemetry before: it has been put there.
POSE_JUMPED = 20.0


@dataclass(frozen=True)
class _Seen:
    """What the newest telemetry said."""

    time: float  # [s] of the simulator's clock
    x: float  # [m]
    y: float  # [m]
    sample_count: int


class RunTracker:
    """Numbers the runs, and stamps telemetries so that stamps never fall back."""

    def __init__(self) -> None:
        self._run: Run | None = None
        self._last: _Seen | None = None
        self._stamp = -1  # [ns] of the newest telemetry
        self._offset = 0  # [ns] from the simulator's clock to the stamps of this run
        self._requested = False

    def request(self, number: int) -> None:
        """Begin a new run with the next telemetry, if the run of this number is the present one.

        Commands that were under way when the run ended ask for the same once more.
        """
        if self._run is not None and number == self._run.number:
            self._requested = True

    def track(self, telemetry: Telemetry, time: float) -> tuple[Run, int]:
        """The run of a telemetry, and its stamp [ns]: unique, and later than the one before.

        `time` [s] is the simulator's clock, or the wall's where the simulator tells none. It is
        the stamp as long as it does not fall back; a later run continues after the stamps before.
        """
        seen = _Seen(time, telemetry.pose.x, telemetry.pose.y, telemetry.sample_count)
        clock = round(time * 1e9)
        if self._run is None or self._requested or self._is_new(seen):
            self._offset = max(0, self._stamp + 1 - clock)
            number = 1 if self._run is None else self._run.number + 1
            self._run = Run(number, max(clock + self._offset, self._stamp + 1))
            self._requested = False
        self._last = seen
        self._stamp = max(clock + self._offset, self._stamp + 1)
        return self._run, self._stamp

    def _is_new(self, seen: _Seen) -> bool:
        last = self._last
        assert last is not None
        elapsed = seen.time - last.time
        if elapsed < -CLOCK_FELL_BACK or seen.sample_count > last.sample_count:
            return True
        moved = math.hypot(seen.x - last.x, seen.y - last.y)
        return moved > POSE_JUMPED + ROVER.max_speed * max(0.0, elapsed)
