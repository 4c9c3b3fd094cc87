"""How often the rover touched a wall or a boulder."""

from __future__ import annotations

import math

WALL_HEIGHT = 0.1  # [m] of ground under the rover that counts as touching a wall
SECONDS = 0.5  # [s] after which another touch is another contact


class Contacts:
    """Counts touches that follow a while without one."""

    def __init__(self, count: int = 0) -> None:
        self.count = count
        self._untouched = math.inf  # [s] since the last touch

    def note(self, blocked: bool, ground: float, seconds: float) -> None:
        """A step of so many seconds: blocked by a boulder, on ground of this height [m]."""
        if blocked or ground > WALL_HEIGHT:
            self.count += self._untouched > SECONDS
            self._untouched = 0.0
        else:
            self._untouched += seconds
