"""TILT_INTERRUPT: stops, marks what it met for good, and backs to level ground on its own track."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, distance_between
from rover_decision.trouble import Trouble, first_trouble
from rover_heat.mission.back_track import REACHED, SPEED, towards
from rover_heat.mission.chart import Event, State
from rover_heat.mission.ownership import STAND
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.states.driving import limits_of
from rover_heat.mission.tick import HeatAction, HeatBehavior, HeatTick
from rover_heat.scan_window import ranges_around

DEADLINE = 8.0  # [s] for each pose to back to
MOST_TARGETS = 3  # poses that are tried
OLDER = 3  # poses from one target to the next
WATCH, FREE = math.radians(30.0), 0.19  # [rad], [m] that must be free where it drives to
TOUCH = 0.165  # [m] from the axle to a wall
STANDING = 0.5  # [s] after which a jolt is over: the stop at the change of the owner
LEVEL = 0.5  # of the tilt that the rules allow


class TiltInterrupt(HeatBehavior):
    """Standing, it makes sure first: braking and accelerating show as a tilt for a moment."""

    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self._limits = limits_of(parts.config)
        self._met: Pose | None = None  # where the tilt was noticed, until it is known what it was
        self._targets: list[Pose] = []
        self._since = 0.0  # [s] of the present target

    def enter(self, tick: HeatTick, before: State) -> None:
        self.recoveries += 1
        parts = self._parts
        parts.trip.cancel()
        self._targets = parts.track.targets(tick.pose)[::OLDER][:MOST_TARGETS]
        self._since, self._met = tick.time, tick.pose
        if parts.tilt.share <= 1.0:
            self._met = None
            parts.ramps.block_ahead(tick.pose)
            parts.notices.append("the wheels turn and the robot does not move: blocked ahead")

    def update(self, tick: HeatTick) -> None:
        if self._met is not None and tick.since >= STANDING:
            self._mark(self._met)
            self._met = None
        if self._targets and tick.time - self._since > DEADLINE:
            self._targets, self._since = self._targets[1:], tick.time

    def _mark(self, met: Pose) -> None:
        """What made the robot tilt at a pose: a ramp, a wall, or nothing."""
        parts = self._parts
        hits = parts.sensing.scans.newest
        if _touches(met, hits):
            parts.notices.append("tilt: it leans on a wall")
        elif parts.tilt.share < LEVEL:
            self._targets = []
            parts.notices.append("tilt: level when it stands: it was a jolt")
        else:
            ramp = parts.ramps.meet(met, parts.tilt.lean, hits)
            rise = math.degrees(ramp.yaw)
            parts.notices.append(
                f"tilt: a ramp from ({ramp.x:.2f}, {ramp.y:.2f}) m that rises to {rise:.0f} degrees"
            )

    def event(self, tick: HeatTick) -> Event | None:
        trouble = first_trouble(tick.health, self._limits, {Trouble.input_gap, Trouble.clock_apart})
        if trouble is not None:
            return Event[trouble.name]
        if self._met is not None:
            return None
        if not self._targets:
            return Event.recovered
        back = distance_between(self._targets[0], tick.pose) < REACHED
        return Event.recovered if back and self._parts.tilt.share < LEVEL else None

    def act(self, tick: HeatTick) -> HeatAction:
        if self._met is not None:
            return HeatAction("tilts: stands to make sure")
        if not self._targets:
            return HeatAction("tilts: no pose to back to")
        twist = towards(self._targets[0], tick.pose)
        direction = math.pi if twist.linear < 0.0 else 0.0
        free = float(ranges_around(self._parts.scan, direction, WATCH).min())
        if abs(twist.linear) > 0.0 and free < FREE:
            return HeatAction("tilts: something is in the way back", STAND)
        return HeatAction(f"tilts: backs to level ground at {SPEED:g} m/s", twist)


def _touches(pose: Pose, hits: NDArray[np.float64]) -> bool:
    """Whether a wall that the lidar sees is so near that the robot leans on it."""
    return bool((np.hypot(*(hits - (pose.x, pose.y)).T) < TOUCH).any())
