"""The families of mazes: how large, and with what in them."""

from __future__ import annotations

from dataclasses import dataclass

LANE = 0.61  # [m] width of the lane with the start, by the challenge's drawing
STRIP = 1.02  # [m] width of the strip of end zones


@dataclass(frozen=True)
class Family:
    """Between lane and strip lie `columns` x `rows` cells of about 0.65 m."""

    width: float  # [m] of the field
    height: float  # [m]
    columns: int
    rows: int
    ramp: bool = True
    sources: tuple[int, int] = (1, 3)  # fewest and most in the maze
    ramp_source: float = 0.5  # share of the mazes with one more at the ramp


FAMILIES = {
    "challenge": Family(3.70, 3.28, columns=3, rows=5),
    "large": Family(5.0, 5.0, columns=5, rows=8),
    "flat": Family(3.70, 3.28, columns=3, rows=5, ramp=False, ramp_source=0.0),
    "demo": Family(2.90, 2.66, columns=2, rows=4, sources=(1, 1), ramp_source=0.0),
}
