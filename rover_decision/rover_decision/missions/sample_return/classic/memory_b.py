"""What classic B remembers from frame to frame: when each thing happened last."""

from __future__ import annotations

import math

from rover_common.geometry import Pose, distance_between

PERIOD = 10.0  # [s] between two looks at the position
LEAST_TRAVEL = 1.0  # [m] in a period
AFTER_STUCK = 10.0  # [s]
AFTER_PICKUP = 20.0  # [s]
AFTER_STOP = 10.0  # [s]
LARGE_STEERING = math.radians(8.0)
CIRCLE_SECONDS = 10.0  # [s] of large steering


class Occasions:
    """When it last stopped, was stuck, picked up, and steered little; all [s]."""

    def __init__(self) -> None:
        self.stop = self.stuck = self.pickup = -math.inf
        self._low_steering: float | None = None

    def steered(self, time: float, steering: float) -> None:
        """The steering angle [rad] that was commanded last."""
        if self._low_steering is None or abs(steering) <= LARGE_STEERING:
            self._low_steering = time

    def circles(self, time: float) -> bool:
        """Whether it has steered to a side for long, and nothing else explains that."""
        return (
            self._low_steering is not None
            and time - self._low_steering >= CIRCLE_SECONDS
            and time - self.stop >= AFTER_STOP
            and time - self.stuck >= AFTER_STUCK
            and time - self.pickup >= AFTER_PICKUP
        )

    def may_be_stuck(self, time: float) -> bool:
        """Whether to stand still would be no wonder."""
        return time - self.stuck >= AFTER_STUCK and time - self.pickup >= AFTER_PICKUP


class TravelCheck:
    """Looks at the position every 10 s: has it moved by a metre?"""

    def __init__(self) -> None:
        self._last: tuple[float, Pose] | None = None
        self.stands = False  # at this frame, by a look at the position

    def update(self, time: float, pose: Pose) -> None:
        """Once per frame."""
        if self._last is None:
            self._last = (time, pose)
        then, place = self._last
        due = time - then >= PERIOD
        self.stands = due and distance_between(place, pose) <= LEAST_TRAVEL
        if due:
            self._last = (time, pose)
