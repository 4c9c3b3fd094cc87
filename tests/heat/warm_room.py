"""An analytic room: walls as segments with warm patches, seen by a lidar and thermal sensors."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BURGER
from rover_common.geometry import Pose
from rover_common.sensor_types import LaserScan, ThermalFrame

RAYS = 230
SUBRAYS = 3  # of a pixel, in both directions
PIXELS = BURGER.thermal_pixels


@dataclass(frozen=True)
class Patch:
    """A warm place on the left side of a wall, as seen from its first to its second end."""

    wall: int
    along: float  # [m] from the wall's first end
    excess: float = 9.0  # [K]
    sigma: float = 0.11  # [m]
    height: float = 0.20  # [m]


@dataclass(frozen=True)
class Room:
    """Walls (n, 4) [m]: x0, y0, x1, y1; rays see them from both sides."""

    walls: NDArray[np.float64]
    patches: tuple[Patch, ...] = ()
    air: float = 24.0  # [C]

    def cast(
        self, x: float, y: float, angles: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
        """Ranges (n,) [m] of level rays, and which wall each met; inf and -1 for none."""
        start, end = self.walls[:, :2], self.walls[:, 2:]
        ray = np.stack([np.cos(angles), np.sin(angles)], axis=1)[:, None]
        edge = (end - start)[None]
        to_start = (start - (x, y))[None]
        cross = ray[..., 0] * edge[..., 1] - ray[..., 1] * edge[..., 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            away = (to_start[..., 0] * edge[..., 1] - to_start[..., 1] * edge[..., 0]) / cross
            share = (to_start[..., 0] * ray[..., 1] - to_start[..., 1] * ray[..., 0]) / cross
        met = (away > 0.0) & (share >= 0.0) & (share <= 1.0)
        away = np.where(met, away, np.inf)
        wall = np.argmin(away, axis=1)
        ranges = away[np.arange(len(angles)), wall]
        return ranges, np.where(np.isfinite(ranges), wall, -1)

    def scan(self, pose: Pose, stamp: int, rng: np.random.Generator | None = None) -> LaserScan:
        """All rays at once, from the lidar's place."""
        angles = 2.0 * math.pi / RAYS * np.arange(RAYS)
        x = pose.x + BURGER.lidar_x * math.cos(pose.yaw)
        y = pose.y + BURGER.lidar_x * math.sin(pose.yaw)
        ranges, _ = self.cast(x, y, angles + pose.yaw)
        if rng is not None:
            ranges = ranges + rng.standard_normal(RAYS) * (0.005 + 0.01 * np.minimum(ranges, 9.0))
        ranges = np.where(ranges <= BURGER.lidar_range_max, ranges, 0.0)
        return LaserScan(
            stamp, 0.0, 2.0 * math.pi / RAYS, 0.0, BURGER.lidar_range_min, BURGER.lidar_range_max,
            ranges.astype(np.float32),
        )  # fmt: skip

    def celsius(
        self, pose: Pose, yaw: float, rng: np.random.Generator | None = None, offset: float = 0.0
    ) -> NDArray[np.float32]:
        """(8, 8) [C] of a sensor mounted at this yaw [rad]."""
        fine = PIXELS * SUBRAYS
        angles = (0.5 - (np.arange(fine) + 0.5) / fine) * BURGER.thermal_field
        ranges, wall = self.cast(pose.x, pose.y, pose.yaw + yaw + angles)
        warmth = np.zeros((fine, fine))
        for patch in self.patches:
            x0, y0, x1, y1 = self.walls[patch.wall]
            length = math.hypot(x1 - x0, y1 - y0)
            ux, uy = (x1 - x0) / length, (y1 - y0) / length
            if -uy * (pose.x - x0) + ux * (pose.y - y0) <= 0.0:
                continue  # the cold side
            directions = pose.yaw + yaw + angles
            hits_x = pose.x + ranges * np.cos(directions)
            hits_y = pose.y + ranges * np.sin(directions)
            along = (hits_x - x0) * ux + (hits_y - y0) * uy - patch.along
            up = BURGER.thermal_z + ranges[None] * np.tan(angles[:, None]) - patch.height
            seen = patch.excess * np.exp(-(along[None] ** 2 + up**2) / (2.0 * patch.sigma**2))
            warmth += np.where(wall == patch.wall, seen, 0.0)
        pixels = warmth.reshape(PIXELS, SUBRAYS, PIXELS, SUBRAYS).mean(axis=(1, 3))
        noise = 0.0 if rng is None else 0.16 * rng.standard_normal(pixels.shape)
        return (np.round((self.air + offset + pixels + noise) * 4.0) / 4.0).astype(np.float32)

    def thermal(
        self, pose: Pose, stamp: int, sensor: int, yaw: float, *args: float
    ) -> ThermalFrame:
        return ThermalFrame(stamp, sensor, self.celsius(pose, yaw, *args))

    def place_of(self, patch: Patch) -> tuple[float, float]:
        """[m] The middle of a patch."""
        x0, y0, x1, y1 = self.walls[patch.wall]
        share = patch.along / math.hypot(x1 - x0, y1 - y0)
        return x0 + share * (x1 - x0), y0 + share * (y1 - y0)


def box(width: float, height: float) -> NDArray[np.float64]:
    """Four walls around the inside, counter-clockwise: their left side is the inner one."""
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    return np.hstack([corners, np.roll(corners, -1, axis=0)])


def hits_of(room: Room, pose: Pose, rng: np.random.Generator | None = None) -> NDArray[np.float64]:
    """(n, 2) [m] What the lidar meets from a pose, in the room's frame."""
    scan = room.scan(pose, 0, rng)
    met = scan.ranges > 0.0
    angles = pose.yaw + scan.angle_increment * np.flatnonzero(met)
    x = pose.x + BURGER.lidar_x * math.cos(pose.yaw) + scan.ranges[met] * np.cos(angles)
    y = pose.y + BURGER.lidar_x * math.sin(pose.yaw) + scan.ranges[met] * np.sin(angles)
    return np.stack([x, y], axis=1)
