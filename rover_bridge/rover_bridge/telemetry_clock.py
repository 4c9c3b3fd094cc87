"""The time of a telemetry: the simulator's clock if it goes on as clocks do, or the machine's.

A clock that jumps, stands or is gone is refused, so that the rover stands. It is confirmed when
further telemetries go on from there: a clock that has fallen back then begins a run, one that is
ahead continues the present one without the time that was left out.
"""

from __future__ import annotations

from dataclasses import dataclass

from rover_bridge.errors import (
    ClockAbsentError,
    ClockJumpedError,
    ClockStandsError,
    TelemetryError,
)
from rover_bridge.run_tracker import CLOCK_FELL_BACK

# [s] by which simulated time may be ahead: so much, and so many times the wall time that has
# passed. A simulator that is faster than real time drives on while nobody answers it.
JUMPED_AHEAD, FASTEST = 5.0, 20.0
# Telemetries, each later than the one before, that confirm a clock that jumped. Requests that are
# pending together may show one instant several times.
CONFIRMATIONS = 5
# [s] of wall time, and telemetries, of one instant: more than can be pending together.
STANDS, STANDING_TELEMETRIES = 0.5, 10


@dataclass(frozen=True)
class _Reading:
    time: float  # [s] of the clock that was read
    simulated: bool  # whether it is the simulator's
    now: float  # [s] of the steady clock


class TelemetryClock:
    """Gives each telemetry its time; `now` is always the steady clock, which nobody sets."""

    def __init__(self, wall: float, now: float, required: bool) -> None:
        """wall: [s] of the machine's clock at `now`; required: whether sim_time is needed."""
        self._wall_offset = wall - now
        self._required = required
        self._last: _Reading | None = None  # that was confirmed
        self._shift = 0.0  # [s] by which times are ahead of what is given
        self._standing = 0  # telemetries of the last one's instant
        self._suspect: _Reading | None = None  # the newest one of a clock that jumped
        self._jumped_to = 0.0  # [s] the first one
        self._confirmations = 0
        self.jump_confirmed = False  # by the telemetry that was read last

    def read(self, sim_time: float | None, now: float, anew: bool = False) -> float:
        """The time [s] of a telemetry that came now; anew: the first one of another connection.

        Raises ClockAbsentError, ClockJumpedError or ClockStandsError.
        """
        simulated = sim_time is not None
        if self._required and not simulated:
            raise ClockAbsentError("no sim_time, which use_sim_time needs: start without it")
        reading = _Reading(
            self._wall_offset + now if sim_time is None else sim_time, simulated, now
        )
        last, error = self._last, self._jump(reading)
        self.jump_confirmed = error is not None and self._confirmed(reading)
        if error is not None:
            if not (self.jump_confirmed or anew):
                raise error
            self._continue(reading)
        elif last is not None and reading.time <= last.time:
            self._stand(reading, last)
            return reading.time - self._shift
        self._last, self._suspect, self._standing = reading, None, 0
        return reading.time - self._shift

    def _jump(self, reading: _Reading) -> TelemetryError | None:
        """Why this cannot be the clock that was read before."""
        last = self._last
        if last is None:
            return None
        if reading.simulated != last.simulated:
            if last.simulated:
                return ClockAbsentError("no sim_time, which came before")
            return ClockJumpedError("a sim_time, which did not come before")
        elapsed = reading.time - last.time
        if elapsed < -CLOCK_FELL_BACK:
            return ClockJumpedError(f"sim_time fell back by {-elapsed:.1f} s")
        if elapsed > JUMPED_AHEAD + FASTEST * (reading.now - last.now):
            return ClockJumpedError(f"sim_time jumped ahead by {elapsed:.1f} s")
        return None

    def _confirmed(self, reading: _Reading) -> bool:
        """Whether enough telemetries have gone on from where the clock jumped to."""
        before = self._suspect
        follows = (
            before is not None
            and before.simulated == reading.simulated
            and 0.0 <= reading.time - before.time <= JUMPED_AHEAD
        )
        if before is None or not follows:
            self._jumped_to, self._confirmations = reading.time, 0
        elif reading.time > before.time:
            self._confirmations += 1
        self._suspect = reading
        return self._confirmations >= CONFIRMATIONS

    def _continue(self, reading: _Reading) -> None:
        """Go on with it: where the time was, if it is ahead of that, else as it is."""
        last = self._last
        assert last is not None
        ahead = self._jumped_to - (last.time - self._shift)
        within = reading.simulated == last.simulated and ahead > JUMPED_AHEAD
        self._shift = ahead if within else 0.0

    def _stand(self, reading: _Reading, last: _Reading) -> None:
        """Another telemetry of the last instant; raises ClockStandsError."""
        self._standing += 1
        seconds = reading.now - last.now
        if seconds > STANDS and self._standing > STANDING_TELEMETRIES:
            raise ClockStandsError(f"sim_time stands at {last.time:.2f} s for {seconds:.1f} s")
