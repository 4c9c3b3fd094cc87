"""Places that proved impassable, though the map shows no reason."""

from __future__ import annotations

import math
from collections import deque

from rover_common.geometry import Pose, distance_between
from rover_navigation.types import BlockedPlace

AHEAD, RADIUS = 1.0, 0.5  # [m] of a place where there was no way on
STUCK_SECONDS, STOP_SECONDS = 90.0, 8.0  # [s] where it got stuck, or stopped in vain
STOPS = 3  # of them mean that an obstacle is not on the map
SAME_STOP, SAME_STOP_SECONDS = 1.0, 15.0  # [m] [s] within which they are


class BlockedPlaces:
    """What is blocked now."""

    def __init__(self) -> None:
        self.places: tuple[BlockedPlace, ...] = ()
        self._stops: deque[tuple[float, Pose]] = deque(maxlen=STOPS)  # [s] and where

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
        self.block(pose, AHEAD, RADIUS, time + STUCK_SECONDS)

    def stopped(self, time: float, pose: Pose) -> None:
        """No way ahead. When it is so here again and again, block what is ahead."""
        self._stops.append((time, pose))
        near = [
            time - before < SAME_STOP_SECONDS and distance_between(pose, place) < SAME_STOP
            for before, place in self._stops
        ]
        if len(near) == STOPS and all(near):
            self.block(pose, AHEAD, RADIUS, time + STOP_SECONDS)

    def unblock(self) -> bool:
        """Forget what was blocked for a while; whether there was any such place."""
        lasting = tuple(place for place in self.places if math.isinf(place.until))
        unblocked = len(lasting) < len(self.places)
        self.places = lasting
        return unblocked
