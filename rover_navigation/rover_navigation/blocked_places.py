"""Places that proved impassable, though the map shows no reason."""

from __future__ import annotations

import math
from collections import deque
from typing import Any

from rover_common.geometry import Pose, distance_between
from rover_navigation.scale import Scale
from rover_navigation.types import BlockedPlace

STUCK_SECONDS, STOP_SECONDS = 90.0, 8.0  # [s] where it got stuck, or stopped in vain
STOPS = 3  # of them mean that an obstacle is not on the map
SAME_STOP_SECONDS = 15.0  # [s] within which they are


class BlockedPlaces:
    """What is blocked now."""

    def __init__(self, scale: Scale) -> None:
        self._scale = scale
        self.places: tuple[BlockedPlace, ...] = ()
        self._stops: deque[tuple[float, Pose]] = deque(maxlen=STOPS)  # [s] and where

    def memory(self) -> list[Any]:
        """All places, for JSON."""
        return [dict(vars(place)) for place in self.places]

    def restore(self, memory: list[Any]) -> None:
        """Take what `memory` gave; raises TypeError for anything else."""
        self.places = tuple(BlockedPlace(**place) for place in memory)

    def update(self, time: float) -> None:
        """Drop what is blocked no longer at a time [s]."""
        self.places = tuple(place for place in self.places if place.until > time)

    def block(self, pose: Pose, ahead: float, radius: float, until: float = math.inf) -> None:
        """Block a place [m] ahead of a pose until a time [s]."""
        x = pose.x + ahead * math.cos(pose.yaw)
        y = pose.y + ahead * math.sin(pose.yaw)
        self.places = (*self.places, BlockedPlace(x, y, radius, until))

    def stuck(self, time: float, pose: Pose) -> None:
        """The robot got stuck: block what is ahead for a while."""
        self._block_ahead(pose, time + STUCK_SECONDS)

    def stopped(self, time: float, pose: Pose) -> None:
        """No free ground ahead. Block what is ahead when that is so here again and again."""
        self._stops.append((time, pose))
        here = self._scale.same_stop
        near = [
            time - before < SAME_STOP_SECONDS and distance_between(pose, place) < here
            for before, place in self._stops
        ]
        if len(near) == STOPS and all(near):
            self._block_ahead(pose, time + STOP_SECONDS)

    def _block_ahead(self, pose: Pose, until: float) -> None:
        self.block(pose, self._scale.blocked_ahead, self._scale.blocked_radius, until)

    def unblock(self) -> bool:
        """Forget what was blocked for a while; whether there was any such place."""
        lasting = tuple(place for place in self.places if math.isinf(place.until))
        unblocked = len(lasting) < len(self.places)
        self.places = lasting
        return unblocked
