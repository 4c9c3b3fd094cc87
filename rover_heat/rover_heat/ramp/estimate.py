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
STRIDE, SEGMENT = 5, (0.04, 0.4)  # rays from one to another, and [m] between, of one wall
# Cosine of the angle between the rise and where the robot leans: with walls that tell the direction
# only the sense is to be told, else all of it.
ALONG_BETWEEN, ALONG = 0.5, 0.9
# A robot that comes along the lane with one wheel beside the ramp leans to its side: the caster is
# up already, and the pitch alone tells the sense. Standing, the mean is level within half of this.
ALONG_LANE, NOSE_UP = math.radians(30.0), 0.006  # [rad] off the lane, [rad]

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
    """From where the tilt was noticed, how the robot leans, and what the lidar meets (n, 2) [m].

    A ramp lies along walls; where one of their two directions has walls to both sides nearby, it is
    that one, for a robot that meets the ramp aslant leans aside as well.
    """
    uphill = math.atan2(lean.roll, -lean.pitch)  # in base_footprint
    rear = BURGER.caster_x if abs(uphill) > math.pi / 2 else 0.0  # what rose first
    x, y = pose.x + rear * math.cos(pose.yaw), pose.y + rear * math.sin(pose.yaw)
    yaw, between = _direction(x, y, wrap_angle(pose.yaw + uphill), hits)
    ends = _end_first(pose, lean, yaw) if between else None
    yaw = yaw if ends is None else ends
    middle = _middle_between_walls(x, y, yaw, hits)
    aside = 0.0 if middle is None else middle
    along = math.cos(wrap_angle(pose.yaw + uphill - yaw))
    cos, sin = math.cos(yaw), math.sin(yaw)
    return Ramp(
        x - FIRED_BEYOND * cos - aside * sin,
        y - FIRED_BEYOND * sin + aside * cos,
        yaw,
        straight=ends is not None or along >= (ALONG_BETWEEN if between else ALONG),
        between=between,
    )


def _direction(x: float, y: float, uphill: float, hits: Points) -> tuple[float, bool]:
    """[rad] Of the rise at a place, and whether it is known by walls to both sides of it alone."""
    wall = _wall_direction(hits)
    if wall is None:
        return uphill, False
    axes = [wall, wall + math.pi / 2]
    between = [axis for axis in axes if _middle_between_walls(x, y, axis, hits) is not None]
    sides = [wrap_angle(axis + turn) for axis in between or axes for turn in (0.0, math.pi)]
    return min(sides, key=lambda side: abs(wrap_angle(side - uphill))), len(between) == 1


def _end_first(pose: Pose, lean: Lean, lane: float) -> float | None:
    """[rad] Of the rise, for a robot that came up it along the lane [rad]; None for another one."""
    comes = pose.yaw if lean.pitch < 0.0 else pose.yaw + math.pi
    rise = min((lane, lane + math.pi), key=lambda yaw: abs(wrap_angle(yaw - comes)))
    along = abs(wrap_angle(rise - comes)) <= ALONG_LANE
    return wrap_angle(rise) if along and abs(lean.pitch) >= NOSE_UP else None


def _wall_direction(hits: Points) -> float | None:
    """[rad] Of the walls around, up to quarter turns; None where they have no two directions."""
    steps = hits[STRIDE:] - hits[:-STRIDE]
    length = np.hypot(*steps.T)
    steps = steps[(length > SEGMENT[0]) & (length < SEGMENT[1])]
    if len(steps) == 0:
        return None
    fourfold = np.exp(4j * np.arctan2(steps[:, 1], steps[:, 0])).mean()
    return float(np.angle(fourfold)) / 4.0 if abs(fourfold) > ORTHOGONAL else None


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
