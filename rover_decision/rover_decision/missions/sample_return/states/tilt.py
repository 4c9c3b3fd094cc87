"""TILT: tilted too far. Stops and backs to its last level pose; the place is blocked for good."""

from __future__ import annotations

from rover_common.geometry import Pose
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action
from rover_navigation.actuation import Actuation
from rover_navigation.blocked_places import BlockedPlaces
from rover_navigation.recovery import SafePoses, back_to

AHEAD, RADIUS = 0.6, 0.5  # [m] of the place that is blocked
DEADLINE = 6.0  # [s]


class Tilt(StateBehavior):
    def __init__(self, safe_poses: SafePoses, blocked: BlockedPlaces, actuation: Actuation) -> None:
        self._safe_poses = safe_poses
        self._blocked = blocked
        self._actuation = actuation
        self._safe_pose: Pose | None = None  # to back to

    def enter(self, tick: TickContext, before: State) -> None:
        self.recoveries += 1
        self._safe_pose = self._safe_poses.target(tick.pose)
        self._blocked.block(tick.pose, AHEAD, RADIUS)

    def event(self, tick: TickContext) -> Event | None:
        back = self._safe_poses.reached(self._safe_pose, tick.pose)
        return Event.recovered if back or tick.since > DEADLINE else None

    def act(self, tick: TickContext) -> Action:
        command = back_to(self._safe_pose, tick.pose, tick.speed, self._actuation)
        return command, "tilts too far: backs to level ground"
