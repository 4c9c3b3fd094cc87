"""Rocks as places on the map: one rock for all that is seen within the radius of the score."""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from typing import Any

from rover_common.types import RockTrack

SAME_ROCK = 3.0  # [m] the community's score takes a rock on the map for the sample this near
CELL_VARIANCE = 1.0 / 12.0  # [m^2] of a point somewhere in a cell of 1 m


class RockList:
    """Grows by the nearest rock of each frame; the newest observation places a rock."""

    def __init__(self) -> None:
        self._rocks: list[RockTrack] = []

    @property
    def rocks(self) -> tuple[RockTrack, ...]:
        return tuple(self._rocks)

    def memory(self) -> list[Any]:
        """All of them, for JSON."""
        return [asdict(rock) for rock in self._rocks]

    def restore(self, memory: list[Any]) -> None:
        """Take what `memory` gave; raises TypeError or KeyError for anything else."""
        self._rocks = [
            RockTrack(**{**rock, "covariance": tuple(rock["covariance"])}) for rock in memory
        ]

    def add(self, x: float, y: float, stamp: int) -> None:
        """A rock was seen at a place [m] of the map frame."""
        for index, rock in enumerate(self._rocks):
            if math.hypot(rock.x - x, rock.y - y) < SAME_ROCK:
                count = rock.observations + 1
                self._rocks[index] = replace(rock, x=x, y=y, observations=count, last_seen=stamp)
                return
        covariance = (CELL_VARIANCE, 0.0, 0.0, CELL_VARIANCE)
        self._rocks.append(RockTrack(len(self._rocks) + 1, x, y, covariance, 1, stamp))
