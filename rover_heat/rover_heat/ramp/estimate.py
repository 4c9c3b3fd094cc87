"""Where a ramp begins and which way it rises, from one encounter with it.

The lidar looks over the ramp: what tells of it is the tilt, and where the robot was when it began.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BURGER
from rover_common.geometry import Pose, wrap_angle
from rover_heat.tilt import Lean

WIDTH = 0.50  # [m] of the challenge's ramp
# [m] from the foot to the axle when the mean of 0.3 s says that it tilts: 0.04 at a creep, 0.07 at
# 0.2 m/s, for the pitch grows until the caster is on the slope as well
FIRED_BEYOND = 0.055
SIDE_WINDOW = math.radians(8.0)  # around straight to either side, for the walls beside
SIDE_REACH = 1.0  # [m] of a wall that counts as beside
BESIDE = 1.3  # [m] between two such walls at most: the ramp lies in their middle
ORTHOGONAL = 0.5  # of 1: how much the walls around agree on two directions
SEGMENT = 0.15  # [m] between neighbouring rays that may lie on one wall
STRAIGHT_ON = 2.0  # times the roll is the pitch of a robot that climbs on both wheels

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Ramp:
    """In metres in the map frame, whatever the map does."""

    x: float  # [m] middle of the foot line
    y: float  # [m]
    yaw: float  # [rad] of the rise
    straight: bool = True  # met on both wheels: the direction is that of the rise
    between: bool = True  # walls: it lies in a lane

    def before_foot(self, distance: float) -> Pose:
        """The pose in line with it, a distance [m] before the foot, facing it."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return Pose(self.x - distance * cos, self.y - distance * sin, self.yaw)

    def along_and_across(self, x: float, y: float) -> tuple[float, float]:
        """[m] beyond the foot line, and to the left of the middle."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        dx, dy = x - self.x, y - self.y
        return cos * dx + sin * dy, -sin * dx + cos * dy


def estimate_ramp(pose: Pose, lean: Lean, hits: Points) -> Ramp:
    """From where the tilt was noticed, how the robot leans, and what the lidar meets (n, 2) [m]."""
    uphill = math.atan2(lean.roll, -lean.pitch)  # in base_footprint
    yaw = _along_walls(wrap_angle(pose.yaw + uphill), hits)
    cos, sin = math.cos(yaw), math.sin(yaw)
    rear = BURGER.caster_x if abs(uphill) > math.pi / 2 else 0.0  # what rose first
    x, y = pose.x + rear * math.cos(pose.yaw), pose.y + rear * math.sin(pose.yaw)
    aside = _middle_between_walls(x, y, yaw, hits)
    straight = abs(lean.pitch) > STRAIGHT_ON * abs(lean.roll)
    x -= FIRED_BEYOND * cos + (aside or 0.0) * sin
    y -= FIRED_BEYOND * sin - (aside or 0.0) * cos
    return Ramp(x, y, yaw, straight, between=aside is not None)


def _along_walls(yaw: float, hits: Points) -> float:
    """The direction of the walls around, or across them, that is nearest to a yaw [rad].

    The yaw itself where the walls have no two directions.
    """
    steps = np.diff(hits, axis=0)
    length = np.hypot(*steps.T)
    steps = steps[(length > 0.0) & (length < SEGMENT)]
    if len(steps) == 0:
        return yaw
    fourfold = np.exp(4j * np.arctan2(steps[:, 1], steps[:, 0])).mean()
    if abs(fourfold) < ORTHOGONAL:
        return yaw
    wall = float(np.angle(fourfold)) / 4.0
    quarter = math.pi / 2
    return wrap_angle(wall + quarter * round((yaw - wall) / quarter))


def _middle_between_walls(x: float, y: float, yaw: float, hits: Points) -> float | None:
    """[m] to the left of a place, of the middle between the walls beside it; None without both."""
    offsets = hits - (x, y)
    ranges = np.hypot(*offsets.T)
    bearings = np.arctan2(offsets[:, 1], offsets[:, 0]) - yaw
    sides = []
    for side in (1.0, -1.0):
        aside = np.abs(np.angle(np.exp(1j * (bearings - side * math.pi / 2))))
        beside = (aside < SIDE_WINDOW) & (ranges < SIDE_REACH)
        if not beside.any():
            return None
        sides.append(float(np.median(ranges[beside])))
    left, right = sides
    return (left - right) / 2 if left + right <= BESIDE else None
