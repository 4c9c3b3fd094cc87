"""When a run begins, and the stamps of its telemetries: the only place that decides it.

A simulator that is reset, reloaded or replaced begins a new run: its clock falls back or has
another source, its rover stands somewhere else, or samples that were collected are there again. So
does a command with new_run.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.types import Run, Telemetry
from rover_common.vehicle import ROVER

# [s] by which the clock falls back. Within a run a simulator's clock never does; a wall clock that
# is set by the network falls back by less.
CLOCK_FELL_BACK = 0.5
# [m] beyond what the rover can have driven since the telemetry before: it was placed there.
POSE_JUMPED = 20.0


@dataclass(frozen=True)
class _Observed:
    """What the newest telemetry says of its run."""

    time: float  # [s] of the simulator's clock, or of the wall's
    simulated: bool  # whether it is the simulator's
    x: float  # [m] map frame
    y: float  # [m]
    sample_count: int


class RunTracker:
    """Numbers the runs, and stamps telemetries so that stamps never fall back."""

    def __init__(self) -> None:
        self._run: Run | None = None
        self._last: _Observed | None = None
        self._stamp = -1  # [ns] of the newest telemetry
        self._offset = 0  # [ns] from the clock to the stamps of this run
        self._requested = False
        self.reason = ""  # why the present run began

    def request(self, number: int) -> None:
        """Begin a new run with the next telemetry, if the run of this number is the present one.

        So further commands on frames of the run that ended do not begin another one.
        """
        if self._run is not None and number == self._run.number:
            self._requested = True

    def track(self, telemetry: Telemetry, time: float) -> tuple[Run, int]:
        """The run of a telemetry, and its stamp [ns]: unique, and later than the one before.

        `time` [s] is the simulator's clock, or the wall's where the telemetry has no sim_time. It
        is the stamp as long as it does not fall back; a later run continues after the stamps
        before.
        """
        observed = _Observed(
            time,
            telemetry.sim_time is not None,
            telemetry.pose.x,
            telemetry.pose.y,
            telemetry.sample_count,
        )
        clock = round(time * 1e9)
        reason = self._reason_for_run(observed)
        if self._run is None or reason:
            self.reason = reason
            self._offset = max(0, self._stamp + 1 - clock)
            number = 1 if self._run is None else self._run.number + 1
            self._run = Run(number, clock + self._offset)
            self._requested = False
        self._last = observed
        self._stamp = max(clock + self._offset, self._stamp + 1)
        return self._run, self._stamp

    def _reason_for_run(self, observed: _Observed) -> str:
        """Why this telemetry begins a run; empty when it does not."""
        last = self._last
        if last is None:
            return "the first telemetry"
        if self._requested:
            return "a command asked for it"
        elapsed = observed.time - last.time
        if observed.simulated != last.simulated:
            return "the clock has another source"
        if elapsed < -CLOCK_FELL_BACK:
            return f"the clock fell back by {-elapsed:.1f} s"
        if observed.sample_count > last.sample_count:
            return f"{observed.sample_count} samples are left, after {last.sample_count}"
        moved = math.hypot(observed.x - last.x, observed.y - last.y)
        if moved > POSE_JUMPED + ROVER.max_speed * max(0.0, elapsed):
            return f"the rover stands {moved:.0f} m away"
        return ""
