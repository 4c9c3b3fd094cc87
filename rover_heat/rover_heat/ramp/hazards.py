"""Places to keep away from though the lidar sees none of them, in metres in the map frame."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import GridMap
from rover_heat.ramp.estimate import WIDTH, Ramp
from rover_navigation.types import BlockedPlace

BEFORE_FOOT = 0.10  # [m] of ground before the foot that is kept away from as well
DISC = 0.20  # [m] around where the tilt was noticed
OCCUPIED = 100  # of a cell
FRACTION = 4  # bits of the drawing's fractions of a cell


@dataclass(frozen=True)
class Strip:
    """A rectangle."""

    start: Pose  # middle of its near side, looking along it
    length: float  # [m]
    width: float  # [m]

    def corners(self) -> NDArray[np.float64]:
        """(4, 2) [m]"""
        along = self.length * np.array([math.cos(self.start.yaw), math.sin(self.start.yaw)])
        aside = 0.5 * self.width * np.array([-math.sin(self.start.yaw), math.cos(self.start.yaw)])
        near = np.array([self.start.x, self.start.y])
        return np.array([near - aside, near + along - aside, near + along + aside, near + aside])


@dataclass(frozen=True)
class Hazards:
    """All of them, for good."""

    strips: tuple[Strip, ...] = ()
    discs: tuple[BlockedPlace, ...] = ()

    def memory(self) -> dict[str, Any]:
        """For JSON."""
        strips = [
            [strip.start.x, strip.start.y, strip.start.yaw, strip.length, strip.width]
            for strip in self.strips
        ]
        return {"strips": strips, "discs": [dict(vars(disc)) for disc in self.discs]}

    @classmethod
    def of(cls, memory: dict[str, Any]) -> Hazards:
        """What `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        strips = (Strip(Pose(x, y, yaw), *size) for x, y, yaw, *size in memory["strips"])
        return cls(tuple(strips), tuple(BlockedPlace(**disc) for disc in memory["discs"]))

    def with_disc(self, pose: Pose) -> Hazards:
        """Also where the robot tilted, or stood before something that it does not see."""
        return Hazards(self.strips, (*self.discs, BlockedPlace(pose.x, pose.y, DISC)))

    def with_ramp(self, ramp: Ramp, length: float) -> Hazards:
        """Also a ramp of a length [m] of ground."""
        start = ramp.before_foot(BEFORE_FOOT)
        return Hazards((*self.strips, Strip(start, length, WIDTH)), self.discs)

    def drawn_into(self, grid: GridMap) -> GridMap:
        """The map with all of them occupied, as far as it is known."""
        if not (self.strips or self.discs):
            return grid
        rows, cols = grid.cells.shape
        geometry = GridGeometry(grid.resolution, rows, cols, grid.origin_x, grid.origin_y)
        mask = np.zeros((rows, cols), np.uint8)
        for strip in self.strips:
            cv2.fillPoly(mask, [_drawn(strip.corners(), geometry)], 1, cv2.LINE_8, FRACTION)
        for disc in self.discs:
            center = _drawn(np.array([[disc.x, disc.y]]), geometry)[0].tolist()
            radius = round(disc.radius / geometry.resolution * 2**FRACTION)
            cv2.circle(mask, center, radius, 1, -1, cv2.LINE_8, FRACTION)
        cells = np.where((mask > 0) & (grid.cells >= 0), np.int8(OCCUPIED), grid.cells)
        return GridMap(grid.resolution, grid.origin_x, grid.origin_y, cells)


NO_HAZARDS = Hazards()


def _drawn(points: NDArray[np.float64], geometry: GridGeometry) -> NDArray[np.int32]:
    """Points (n, 2) [m] as OpenCV's fixed-point pixels, whose whole numbers are cells' centres."""
    origin = np.array([geometry.origin_x, geometry.origin_y])
    pixels = (points - origin) / geometry.resolution - 0.5
    return np.round(pixels * 2**FRACTION).astype(np.int32)
