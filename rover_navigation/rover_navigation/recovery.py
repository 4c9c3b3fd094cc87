"""Recovery: a sequence of timed manoeuvres, each harder than the one before."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.geometry import Pose, bearing_to, distance_between
from rover_common.types import Command
from rover_navigation.actuation import Actuation
from rover_navigation.scale import Scale

PUSH_THROTTLE = 0.6
SAFE_POSES = 30  # kept
ROLLING = 0.2  # [m/s] forward: too fast to be put into reverse


@dataclass(frozen=True)
class RecoveryStep:
    """Back up with the wheels turned, then turn in place, then push straight on."""

    back: float  # [s]
    turn: float  # [s]
    push: float  # [s]

    @property
    def seconds(self) -> float:
        return self.back + self.turn + self.push


RECOVERY_STEPS = (
    RecoveryStep(back=1.5, turn=0.5, push=0.0),
    RecoveryStep(back=2.5, turn=1.5, push=0.0),
    RecoveryStep(back=3.0, turn=2.5, push=2.0),
    RecoveryStep(back=0.5, turn=3.5, push=3.0),
    RecoveryStep(back=4.0, turn=2.0, push=3.0),
)


class RecoverySequence:
    """Which step comes next: one further each time, until the robot got clear."""

    def __init__(self, actuation: Actuation, clear_distance: float) -> None:
        """clear_distance: [m] from where the robot got stuck, beyond which it is clear."""
        self._actuation = actuation
        self._clear_distance = clear_distance
        self._place: Pose | None = None
        self._index = -1
        self._side = 1  # of the turn, +1 left

    def advance(self, pose: Pose, wider_side: int) -> None:
        """Got stuck here; the first turn goes to the wider side, the next to the other."""
        if self._place is None or distance_between(self._place, pose) > self._clear_distance:
            self._place, self._index, self._side = pose, 0, wider_side
        else:
            self._index, self._side = self._index + 1, -self._side

    @property
    def exhausted(self) -> bool:
        return self._index >= len(RECOVERY_STEPS)

    @property
    def step(self) -> RecoveryStep:
        return RECOVERY_STEPS[max(0, self._index) % len(RECOVERY_STEPS)]

    def command(self, speed: float, since: float) -> tuple[Command, str]:
        """What to do `since` [s] after the step began, and what that is called."""
        step = self.step
        if since < step.back:
            steering = -self._side * self._actuation.vehicle.max_steering
            return self._actuation.reverse(steering), "backs up"
        if since < step.back + step.turn:
            turn = self._actuation.turn_in_place(speed, self._side * math.radians(60.0))
            return turn, "turns"
        return Command(throttle=PUSH_THROTTLE), "drives out"


class SafePoses:
    """The last level poses, to back to when the robot tilts too far."""

    def __init__(self, level: float, scale: Scale) -> None:
        """level: [rad] of pitch or roll up to which a pose is one to back to."""
        self._level = level
        self._scale = scale
        self._poses: list[Pose] = []

    def update(self, pose: Pose) -> None:
        level = max(abs(pose.pitch), abs(pose.roll)) < self._level
        spacing = self._scale.safe_pose_spacing
        far = not self._poses or distance_between(self._poses[-1], pose) > spacing
        if level and far:
            self._poses = [*self._poses, pose][-SAFE_POSES:]

    def target(self, pose: Pose) -> Pose | None:
        """The newest that lies far enough behind."""
        away = self._scale.back_distance
        behind = (p for p in reversed(self._poses) if distance_between(p, pose) > away)
        return next(behind, None)

    def reached(self, target: Pose | None, pose: Pose) -> bool:
        """Whether the robot is back at a target."""
        near = self._scale.safe_pose_reached
        return target is not None and distance_between(target, pose) < near


def back_to(safe: Pose | None, pose: Pose, speed: float, actuation: Actuation) -> Command:
    """Stop, then back to a safe pose; straight back where there is none."""
    if speed > ROLLING:
        return actuation.stop()
    if safe is None:
        return actuation.reverse()
    bearing = bearing_to(pose, safe.x, safe.y)
    if abs(bearing) < math.radians(60.0):  # it slid past it
        return actuation.drive(speed, 0.5, bearing)
    return actuation.reverse_towards(bearing)
