"""At which frames maps are due."""

from __future__ import annotations


class MapSchedule:
    """Maps are due at the first frame of a run, and whenever the period has passed."""

    def __init__(self, period: float) -> None:
        """period: [s] of frame time."""
        self._period = round(period * 1e9)
        self._stamp: int | None = None

    def newest(self, stamp: int) -> int:
        """The stamp [ns] of the newest maps that are due at a frame [ns], this or an older one."""
        if self._stamp is None or abs(stamp - self._stamp) >= self._period:
            self._stamp = stamp
        return self._stamp
