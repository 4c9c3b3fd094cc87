"""What classic A remembers from frame to frame."""

from __future__ import annotations

from collections import deque

from rover_common.geometry import Pose

POSITIONS = 15  # frames
DIGITS = 3  # of a position [m]: to the millimetre
MOST_EQUAL = 2  # places that a rover stays on which does not move
PUSH_PERIOD = 15.0  # [s]
PUSH_SECONDS = 1.0  # [s] 3 m at the top speed: out of a circle whose radius is 5 m


class PositionMemory:
    """The last positions: stuck when they are nearly all the same."""

    def __init__(self) -> None:
        self._places: deque[tuple[float, float]] = deque(maxlen=POSITIONS)

    def add(self, pose: Pose) -> None:
        self._places.append((round(pose.x, DIGITS), round(pose.y, DIGITS)))

    def clear(self) -> None:
        """What follows is the attempt to get free."""
        self._places.clear()

    @property
    def stuck(self) -> bool:
        return self._full and len(set(self._places)) <= MOST_EQUAL

    @property
    def free(self) -> bool:
        """Whether it has moved on, over as many frames, since the memory was cleared."""
        return self._full and not self.stuck

    @property
    def _full(self) -> bool:
        return len(self._places) == POSITIONS


class PushTimer:
    """Every 15 s a push straight ahead is due, whatever goes on."""

    def __init__(self) -> None:
        self._last: float | None = None  # [s]

    def update(self, time: float) -> None:
        """The first frame counts as a push."""
        if self._last is None:
            self._last = time

    def due(self, time: float) -> bool:
        return self._last is not None and time - self._last > PUSH_PERIOD

    def pushed(self, time: float) -> None:
        self._last = time
