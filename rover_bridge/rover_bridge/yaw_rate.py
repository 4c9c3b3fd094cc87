"""The yaw rate, which the simulator does not tell, from the yaws of its telemetries."""

from __future__ import annotations

from rover_common.geometry import wrap_angle
from rover_common.types import Run

# [ns] Telemetries of one frame lie 1 ns apart, and those of a wall clock arrive in pairs now and
# then: a rate over less would be one of its jitter.
SHORTEST = 5_000_000
# [ns] After a gap as long as this the mean rate says nothing of the present one.
LONGEST = 1_000_000_000


class YawRate:
    """The mean rate over the time since the telemetry before."""

    def __init__(self) -> None:
        self._run = 0
        self._stamp = 0  # [ns]
        self._yaw = 0.0  # [rad]
        self._rate = 0.0  # [rad/s]

    def follow(self, run: Run, stamp: int, yaw: float) -> float:
        """The rate [rad/s], left positive, at a telemetry of this stamp [ns] and yaw [rad].

        0 at the first telemetry of a run; unchanged at one that follows sooner than SHORTEST.
        """
        elapsed = stamp - self._stamp
        if run.number == self._run and elapsed < SHORTEST:
            return self._rate
        known = run.number == self._run and elapsed <= LONGEST
        self._rate = wrap_angle(yaw - self._yaw) / (elapsed * 1e-9) if known else 0.0
        self._run, self._stamp, self._yaw = run.number, stamp, yaw
        return self._rate
