"""Times of a recorded run's frames, from the names of their pictures."""

from __future__ import annotations

import re
from datetime import datetime

# robocam_2017_05_02_11_16_21_421.jpg: date, time, milliseconds
STAMPED_NAME = re.compile(r"\d{4}(_\d\d){5}_\d{3}")
NOMINAL_PERIOD = 0.04  # [s] between frames whose names carry no time


class FrameClock:
    """Times of the frames [s] from their names, or at the nominal period without them.

    Where the names' time falls back, as between two sessions in one log, the run's time goes on.
    """

    def __init__(self) -> None:
        self._moment: datetime | None = None  # of the frame before
        self._last = -NOMINAL_PERIOD

    def read(self, name: str) -> float:
        """Of the next frame; never less than of the one before."""
        before, self._moment = self._moment, _moment_of(name)
        passed = NOMINAL_PERIOD
        if before is not None and self._moment is not None and self._moment >= before:
            passed = (self._moment - before).total_seconds()
        self._last += passed
        return self._last


def _moment_of(name: str) -> datetime | None:
    match = STAMPED_NAME.search(name)
    if match is None:
        return None
    try:
        return datetime.strptime(match[0], "%Y_%m_%d_%H_%M_%S_%f")
    except ValueError:
        return None
