"""The sampling arm: what it can reach, and its sequence of ten seconds."""

from __future__ import annotations

import math

from rover_common.geometry import Pose
from rover_common.vehicle import ARM_FORWARD, PICKUP_SECONDS

REACH = 0.57  # [m] around the point ahead, by the sample's size 0.55 to 0.60


class Arm:
    """Holds the samples not yet collected, and the sequence that runs."""

    def __init__(self, samples: list[tuple[float, float]]) -> None:
        self.samples = samples
        self._target: tuple[float, float] | None = None
        self._left = 0.0  # [s] of the sequence
        self.frozen = False  # a pickup without a sample near never ends

    @property
    def picking_up(self) -> bool:
        return self._left > 0.0 or self.frozen

    def near_sample(self, pose: Pose) -> bool:
        if self.frozen:
            return False
        return self._target is not None or self._in_reach(pose) is not None

    def start(self, pose: Pose) -> None:
        """Begin the sequence, as a pickup command does, whether a sample is near or not."""
        if self.picking_up:
            return
        self._target = self._in_reach(pose)
        self.frozen = self._target is None
        self._left = 0.0 if self.frozen else PICKUP_SECONDS

    def advance(self, seconds: float) -> None:
        """Time goes on; the sample leaves the lists one frame before the sequence ends."""
        if self._left <= 0.0:
            return
        self._left = round(self._left - seconds, 6)  # so that whole frames add up
        if self._left <= seconds and self._target is not None:
            self.samples.remove(self._target)
            self._target = None

    def _in_reach(self, pose: Pose) -> tuple[float, float] | None:
        x = pose.x + ARM_FORWARD * math.cos(pose.yaw)
        y = pose.y + ARM_FORWARD * math.sin(pose.yaw)
        near = (s for s in self.samples if math.hypot(s[0] - x, s[1] - y) < REACH)
        return next(near, None)
