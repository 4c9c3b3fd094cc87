"""Ways out of trouble, as a ladder: each rung is a timed manoeuvre, the last one is to give up."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.geometry import Pose, wrap_angle
from rover_common.types import Command
from rover_common.vehicle import MAX_STEERING
from rover_navigation import actuation as motion

CLEAR_OF = 2.0  # [m] from where it got stuck: the trouble is over
APPROACH_TILT = 1.5  # of the limit: samples stand on the feet of walls too, and one creeps there
SAFE_TILT = 0.5  # of the limit: a pose to back to
BACK_BY = 0.7  # [m] at least, from where it tilted
AT_SAFE_POSE = 0.4  # [m]
TILT_DEADLINE = 6.0  # [s]


@dataclass(frozen=True)
class Rung:
    """Back up with the wheels turned, then turn on the spot, then push straight on."""

    back: float  # [s]
    turn: float  # [s]
    push: float  # [s]

    @property
    def seconds(self) -> float:
        return self.back + self.turn + self.push


LADDER = (
    Rung(back=1.5, turn=0.5, push=0.0),
    Rung(back=2.5, turn=1.5, push=0.0),
    Rung(back=3.0, turn=2.5, push=2.0),
    Rung(back=0.5, turn=3.5, push=3.0),
    Rung(back=4.0, turn=2.0, push=3.0),
)


class Ladder:
    """Which rung comes next: one up each time, until the rover got clear."""

    def __init__(self) -> None:
        self._place: Pose | None = None
        self._index = -1
        self.side = 1  # of the turn, +1 left

    def climb(self, pose: Pose, roomier: int) -> None:
        """Got stuck here; the first turn goes to the roomier side, the next to the other."""
        if self._place is None or _apart(self._place, pose) > CLEAR_OF:
            self._place, self._index, self.side = pose, 0, roomier
        else:
            self._index, self.side = self._index + 1, -self.side

    @property
    def exhausted(self) -> bool:
        return self._index >= len(LADDER)

    @property
    def rung(self) -> Rung:
        return LADDER[max(0, self._index) % len(LADDER)]

    def command(self, speed: float, since: float) -> tuple[Command, str]:
        """What to do `since` [s] after the manoeuvre's begin."""
        rung = self.rung
        if since < rung.back:
            return motion.reverse(-self.side * MAX_STEERING), "stuck: backs up"
        if since < rung.back + rung.turn:
            return motion.turn_in_place(speed, self.side * math.radians(60.0)), "stuck: turns"
        return Command(throttle=0.6), "stuck: drives out"


class SafePoses:
    """The last level poses, to back to when the rover leans too far."""

    def __init__(self, tilt_limit: float) -> None:
        self._limit = SAFE_TILT * tilt_limit
        self._poses: list[Pose] = []

    def update(self, pose: Pose) -> None:
        level = max(abs(pose.pitch), abs(pose.roll)) < self._limit
        if level and (not self._poses or _apart(self._poses[-1], pose) > 0.2):
            self._poses = [*self._poses, pose][-30:]

    def target(self, pose: Pose) -> Pose | None:
        """The newest that lies far enough behind."""
        behind = (p for p in reversed(self._poses) if _apart(p, pose) > BACK_BY)
        return next(behind, None)


def back_to(safe: Pose | None, pose: Pose, speed: float) -> Command:
    """Stop, then back to a safe pose; straight back where there is none."""
    if speed > 0.2:
        return motion.stop()
    if safe is None:
        return motion.reverse(0.0)
    bearing = wrap_angle(math.atan2(safe.y - pose.y, safe.x - pose.x) - pose.yaw)
    if abs(bearing) < math.radians(60.0):  # it slid past it
        return motion.drive(speed, 0.5, bearing)
    return motion.reverse_towards(bearing)


def is_back(safe: Pose | None, pose: Pose) -> bool:
    return safe is not None and _apart(safe, pose) < AT_SAFE_POSE


def _apart(a: Pose, b: Pose) -> float:
    return math.hypot(a.x - b.x, a.y - b.y)
