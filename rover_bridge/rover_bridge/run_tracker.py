"""When a run begins, and the stamps of its telemetries: the only place that decides it.

A simulator that is reset, reloaded or replaced begins a new run: its clock falls back or has
another source, its rover stands somewhere else, or samples that were collected are there again. So
does a command with new_run. All nodes forget what they know then, so one telemetry is not enough:
several in a row have to agree, and a single wrong one is left out.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import asdict, dataclass, replace
from typing import Any

from rover_common.types import Run, Telemetry
from rover_common.vehicle import ROVER

# [s] by which the clock falls back. Within a run a simulator's clock never does; a wall clock that
# is set by the network falls back by less.
CLOCK_FELL_BACK = 0.5
# [m] beyond what the rover can have driven since the telemetry before: it was placed there.
POSE_JUMPED = 20.0
# [m] the same, beyond which a pose is unlikely: the rover may drive unseen while the bridge stalls.
POSE_OUTLIER = 3.0
CLOCK_LEAPT = 5.0  # [s] a simulator's clock stands while nobody answers; only a free one leaps
PICKED_UP = 1  # sample from one telemetry to the next
# [s] of wall time after which a simulator without a clock counts as another one.
MOST_ABSENCE = 600.0
AT_START = 0.01  # [m] of where the run began: a rover that drove never stands there so exactly
# [ns] by which the stamps of a bridge that is started again are later than the clock: it does not
# know those that it gave after its state was saved.
RESUMED_LATER = 1000
AGREEING = 3  # telemetries in a row that have to agree on what contradicts those before


@dataclass(frozen=True)
class Observed:
    """What a telemetry says of its run."""

    time: float  # [s] of the simulator's clock, or of the wall's
    simulated: bool  # whether it is the simulator's
    x: float  # [m] map frame
    y: float  # [m]
    sample_count: int

    @classmethod
    def of(cls, telemetry: Telemetry, time: float) -> Observed:
        pose, simulated = telemetry.pose, telemetry.sim_time is not None
        return cls(time, simulated, pose.x, pose.y, telemetry.sample_count)

    def breaks_with(self, last: Observed) -> str:
        """Why this cannot be of the same run; empty when it can."""
        elapsed = self.time - last.time
        if self.simulated != last.simulated:
            return "the clock has another source"
        if elapsed < -CLOCK_FELL_BACK:
            return f"the clock fell back by {-elapsed:.1f} s"
        if self.sample_count > last.sample_count:
            return f"{self.sample_count} samples are left, after {last.sample_count}"
        if self.leap_from(last) > POSE_JUMPED:
            moved = math.hypot(self.x - last.x, self.y - last.y)
            return f"the rover stands {moved:.0f} m away"
        return ""

    def follows(self, last: Observed) -> bool:
        """Whether one of two unconfirmed telemetries can be the next of the other."""
        return not self.breaks_with(last) and self.leap_from(last) <= POSE_OUTLIER

    def stands_at(self, other: Observed) -> bool:
        return math.hypot(self.x - other.x, self.y - other.y) < AT_START

    def leap_from(self, last: Observed) -> float:
        """[m] beyond what the rover can have driven."""
        moved = math.hypot(self.x - last.x, self.y - last.y)
        return moved - ROVER.max_speed * max(0.0, self.time - last.time)


class RunTracker:
    """Numbers the runs, and stamps telemetries so that stamps never fall back."""

    def __init__(self) -> None:
        self._run: Run | None = None
        self._last: Observed | None = None
        self._unconfirmed: list[Observed] = []  # in a row; each can follow the one before
        self._counts: deque[int] = deque(maxlen=AGREEING)  # of samples, the newest ones
        self._stamp = -1  # [ns] of the newest telemetry
        self._offset = 0  # [ns] from the clock to the stamps of this run
        self._requested = False
        self._first: Observed | None = None  # of this run
        self._resumed = False  # and nothing was tracked since
        self.reason = ""  # why the present run began
        self.contradiction = ""  # why the newest telemetry is not confirmed yet

    def request(self, number: int) -> None:
        """Begin a new run with the next telemetry, if the run of this number is the present one.

        So further commands on frames of the run that ended do not begin another one.
        """
        if self._run is not None and number == self._run.number:
            self._requested = True

    def track(self, telemetry: Telemetry, time: float) -> tuple[Run, int] | None:
        """The run of a telemetry, and its stamp [ns]: unique, and later than the one before.

        None for one that contradicts those before, until as many as AGREEING do so alike; it
        belongs to no run. `time` [s] is the simulator's clock, or the wall's where the telemetry
        has no sim_time. It is the stamp as long as it does not fall back; a later run continues
        after the stamps before.
        """
        observed = Observed.of(telemetry, time)
        if self._last is None:
            self._begin(observed, "the first telemetry")
        elif self._requested:
            self._begin(observed, "a command asked for it")
        elif self._resumed and (reason := self._another_simulator(observed, self._last)):
            self._begin(observed, reason)
        elif not self._confirms(observed, self._last):
            return None
        else:
            reason = observed.breaks_with(self._last)
            if reason:
                self._begin(observed, reason)
        assert self._run is not None
        self._keep(observed)
        self._stamp = max(round(time * 1e9) + self._offset, self._stamp + 1)
        return self._run, self._stamp

    def memory(self) -> tuple[Run, int, dict[str, Any]] | None:
        """The run, its newest stamp [ns] and what else a bridge needs to go on; None before any."""
        if self._run is None or self._last is None or self._first is None:
            return None
        values = {"offset": self._offset, "last": asdict(self._last), "first": asdict(self._first)}
        return self._run, self._stamp, values

    def resume(self, run: Run, stamp: int, values: dict[str, Any]) -> None:
        """Go on with a run, unless the first telemetry contradicts that.

        Raises ValueError, TypeError or KeyError for values that are none, and changes nothing then.
        """
        offset = int(values["offset"]) + RESUMED_LATER
        last, first = Observed(**values["last"]), Observed(**values["first"])
        self._run, self._stamp, self._offset = run, stamp, offset
        self._last, self._first, self._resumed = last, first, True

    def _begin(self, observed: Observed, reason: str) -> None:
        clock = round(observed.time * 1e9)
        self._offset = max(0, self._stamp + 1 - clock)
        number = 1 if self._run is None else self._run.number + 1
        self._run = Run(number, clock + self._offset)
        self._requested = False
        self._first = observed
        self._counts.clear()
        self.reason = reason

    def _keep(self, observed: Observed) -> None:
        """A count that is too low in one telemetry must not make the next one's a rise."""
        self._counts.append(observed.sample_count)
        self._last, self._unconfirmed = replace(observed, sample_count=max(self._counts)), []
        self._resumed = False

    def _another_simulator(self, observed: Observed, last: Observed) -> str:
        """Why the run ended while no bridge was there; empty when it may go on."""
        absence = observed.time - last.time
        if not observed.simulated and absence > MOST_ABSENCE:
            return f"the last run was {absence:.0f} s ago"
        first = self._first
        if first is not None and observed.stands_at(first) and not last.stands_at(first):
            return "the rover stands where the last run began"
        return ""

    def _confirms(self, observed: Observed, last: Observed) -> bool:
        """Whether it follows the last one, or agrees with enough others that do not."""
        self.contradiction = _contradiction(observed, last)
        if not self.contradiction:
            return True
        if self._unconfirmed and not observed.follows(self._unconfirmed[-1]):
            self._unconfirmed = []
        self._unconfirmed.append(observed)
        return len(self._unconfirmed) >= AGREEING


def _contradiction(observed: Observed, last: Observed) -> str:
    """Why one telemetry can hardly follow another; empty when it can."""
    if observed.leap_from(last) > POSE_OUTLIER:
        return f"the rover cannot have driven to x = {observed.x:.1f}, y = {observed.y:.1f}"
    leapt = observed.time - last.time
    if observed.simulated and leapt > CLOCK_LEAPT:
        return f"the clock leapt by {leapt:.1f} s"
    gone = last.sample_count - observed.sample_count
    if gone > PICKED_UP:
        return f"{gone} samples are gone at once"
    return observed.breaks_with(last)
