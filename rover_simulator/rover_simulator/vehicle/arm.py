"""The sampling arm: what it can reach, and its sequence of ten seconds."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.geometry import Pose, wrap_angle
from rover_common.vehicle import ROVER

Point = tuple[float, float]  # x, y [m] map frame

# The simulator's phases [s]: turn, reach, lift, turn back, place, reset. The gripper holds the
# sample from the end of the reach to the end of the place; then it lies on the flatbed.
PHASES = (1.0, 1.5, 1.5, 1.5, 1.5, 3.0)
GRIPPED, LIFTED, TURNED_BACK, PLACED = 2.5, 4.0, 5.5, 7.0  # [s] ends of the phases between

SHOULDER_FORWARD = ROVER.arm_forward - 0.5  # [m] the reach begins half a metre further ahead
# Where the sample goes is not published; the lengths between are chosen, not measured.
CARRIED_RADIUS = 0.4  # [m] from the shoulder while the arm turns back
FLATBED_RADIUS = SHOULDER_FORWARD - 0.061  # [m] behind the shoulder: the middle of the flatbed


class Arm:
    """The samples not yet collected, and the sequence in progress."""

    def __init__(self, samples: list[Point]) -> None:
        self.samples = samples  # as the telemetry lists them; one in the gripper moves
        self._held: _Held | None = None
        self._left = 0.0  # [s] of the sequence
        self.frozen = False  # a pickup without a sample near never ends

    @property
    def on_the_ground(self) -> list[Point]:
        """The samples where they lie, one in the gripper where it lay."""
        held = self._held
        return [
            held.found if held is not None and index == held.index else sample
            for index, sample in enumerate(self.samples)
        ]

    @property
    def picking_up(self) -> bool:
        return self._left > 0.0 or self.frozen

    @property
    def lifted(self) -> Point | None:
        """Where the sample lay that the gripper has taken from the ground."""
        if self._held is None or ROVER.pickup_seconds - self._left <= GRIPPED:
            return None
        return self._held.found

    def near_sample(self, pose: Pose) -> bool:
        if self.picking_up:  # not checked again before the sequence ends
            return self._held is not None
        return self._in_reach(pose) is not None

    def start(self, pose: Pose) -> None:
        """Begin the sequence, as a pickup command does, whether a sample is near or not."""
        if self.picking_up:
            return
        index = self._in_reach(pose)
        self.frozen = index is None
        if index is not None:
            self._held = _Held.at(self.samples[index], pose, index)
            self._left = ROVER.pickup_seconds

    def advance(self, seconds: float) -> None:
        """Advance the time; the sample leaves the lists one frame before the sequence ends."""
        if self._left <= 0.0:
            return
        self._left = round(self._left - seconds, 6)  # so that whole frames add up
        if self._held is None:
            return
        if self._left <= seconds:
            del self.samples[self._held.index]
            self._held = None
        else:
            self.samples[self._held.index] = self._held.position(ROVER.pickup_seconds - self._left)

    def _in_reach(self, pose: Pose) -> int | None:
        x = pose.x + ROVER.arm_forward * math.cos(pose.yaw)
        y = pose.y + ROVER.arm_forward * math.sin(pose.yaw)
        near = (
            index
            for index, sample in enumerate(self.samples)
            if math.hypot(sample[0] - x, sample[1] - y) < ROVER.arm_radius_median
        )
        return next(near, None)


@dataclass(frozen=True)
class _Held:
    """The sample of the sequence, and its path around the shoulder of a standing rover."""

    index: int  # in the list of samples
    found: Point
    shoulder: Point
    radius: float  # [m] from the shoulder, where it was found
    bearing: float  # [rad] from the rover's forward, where it was found
    yaw: float  # [rad] of the rover

    @classmethod
    def at(cls, found: Point, pose: Pose, index: int) -> _Held:
        shoulder = (
            pose.x + SHOULDER_FORWARD * math.cos(pose.yaw),
            pose.y + SHOULDER_FORWARD * math.sin(pose.yaw),
        )
        dx, dy = found[0] - shoulder[0], found[1] - shoulder[1]
        bearing = wrap_angle(math.atan2(dy, dx) - pose.yaw)
        return cls(index, found, shoulder, math.hypot(dx, dy), bearing, pose.yaw)

    def position(self, elapsed: float) -> Point:
        """Where the sample is, `elapsed` [s] after the sequence began."""
        if elapsed <= GRIPPED:
            return self.found
        lifting = _share(elapsed, GRIPPED, LIFTED)
        turning = _share(elapsed, LIFTED, TURNED_BACK)
        placing = _share(elapsed, TURNED_BACK, PLACED)
        radius = self.radius + lifting * (CARRIED_RADIUS - self.radius)
        radius += placing * (FLATBED_RADIUS - CARRIED_RADIUS)
        behind = math.copysign(math.pi, self.bearing)
        angle = self.yaw + self.bearing + turning * (behind - self.bearing)
        return (
            self.shoulder[0] + radius * math.cos(angle),
            self.shoulder[1] + radius * math.sin(angle),
        )


def _share(time: float, start: float, end: float) -> float:
    """Share of a phase that is over at this time, 0..1."""
    return min(1.0, max(0.0, (time - start) / (end - start)))
