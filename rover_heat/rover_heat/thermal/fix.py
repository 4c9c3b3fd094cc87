"""A fix: one warm frame and the scan of its time give one place on a wall."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, wrap_angle
from rover_heat.config import HeatConfig, thermal_yaw
from rover_heat.thermal.detection import PIXEL, WarmPatch

NEARER_SHARE = 1.0 / 3.0  # of a window's rays, with which a nearer surface is taken
FACE_REACH = 0.12  # [m] of wall to either side that its direction is fitted to
LEAST_FACE = 5  # points, without which the wall is taken to face the robot
OTHERS = 0.25  # of a window's rays on other surfaces, with which the place is not certain
SURFACE_DEPTH = 0.15  # [m] from the chosen surface's mean that a ray of it may lie
GRAZING = math.cos(math.radians(80.0))  # of the ray with the wall's normal, at least
SHARP_OBLIQUE = math.radians(55.0)  # off the wall's normal
SMALLEST = 0.08  # [m] deviation of the smallest patch: one pixel alone is never narrower than that
# Deviations that are added up. A pixel's width alone would be its share of sqrt(12).
BEARING_SIGMA = PIXEL / math.sqrt(12.0)
RANGE_SIGMA, RANGE_SIGMA_SHARE = 0.005, 0.01  # [m] and of the range, of the lidar
POSE_SIGMA = 0.02  # [m]
TIME_SIGMA = 0.1  # [s] of when the frame was taken, and of the pixels' own delay

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Fix:
    """One observation of a warm place."""

    stamp: int  # [ns] when the frame was taken
    sensor: int
    pixel: tuple[int, int]  # the hottest
    x: float  # [m] map frame, on the wall
    y: float  # [m]
    covariance: tuple[float, float, float, float]  # [m^2] xx, xy, yx, yy
    normal: float  # [rad] of the wall, towards where it was seen from
    range: float  # [m] from the robot
    peak: float  # [K] above the surroundings
    # One surface alone, seen well enough: past a wall's end, or along a wall, a pixel's width is
    # too much to tell where the heat is.
    sharp: bool = True


def arrays_of(fixes: Sequence[Fix]) -> dict[str, NDArray[Any]]:
    """Fixes as arrays of n rows each."""
    numbers = [(f.stamp, f.sensor, *f.pixel, f.sharp) for f in fixes]
    values = [(f.x, f.y, *f.covariance, f.normal, f.range, f.peak) for f in fixes]
    return {
        "numbers": np.array(numbers, np.int64).reshape(-1, 5),
        "values": np.array(values, float).reshape(-1, 9),
    }


def fixes_of(arrays: dict[str, NDArray[Any]]) -> list[Fix]:
    """What `arrays_of` gave; raises ValueError or KeyError for anything else."""
    fixes = []
    rows = zip(arrays["numbers"].tolist(), arrays["values"].tolist(), strict=True)
    for (stamp, sensor, row, col, sharp), (x, y, xx, xy, yx, yy, normal, away, peak) in rows:
        place = x, y, (xx, xy, yx, yy), normal, away, peak
        fixes.append(Fix(stamp, sensor, (row, col), *place, sharp=bool(sharp)))
    return fixes


@dataclass(frozen=True)
class View:
    """From where, and how fast, a frame was taken."""

    stamp: int  # [ns]
    sensor: int
    pose: Pose  # of base_footprint in the map; the sensor stands above it
    speed: float  # [m/s]
    turn_rate: float  # [rad/s]
    hits: Points  # (n, 2) [m] map frame: what the lidar met around that time


def make_fix(patch: WarmPatch, view: View, config: HeatConfig) -> Fix | None:
    """The warm place; None where the lidar met nothing there, or too far away."""
    if patch.cut:
        return None
    yaw = view.pose.yaw + thermal_yaw(config, view.sensor)
    if config.heat_bearing == "pixels":
        bearing, window = yaw + patch.azimuth, config.heat_window
    else:
        bearing, window = yaw, config.angle_heat_scan
    origin = np.array([view.pose.x, view.pose.y])
    offsets = view.hits - origin
    ranges = np.hypot(*offsets.T)
    aside = _wrapped(np.arctan2(offsets[:, 1], offsets[:, 0]) - bearing)
    within = np.abs(aside) <= window
    inside = np.flatnonzero(within & (ranges <= config.heat_distance_max))
    if len(inside) == 0:
        return None
    chosen = inside[_surface(ranges[inside], config.mode_bin)]
    direction = bearing + math.atan2(np.sin(aside[chosen]).mean(), np.cos(aside[chosen]).mean())
    distance = float(ranges[chosen].mean())
    middle = origin + distance * np.array([math.cos(direction), math.sin(direction)])
    face = _on_face(middle, view.hits, origin, direction)
    place, normal = face or (middle, wrap_angle(direction + math.pi))
    # Also what is too far away for a fix: a patch there shows past a wall's end.
    others = np.abs(ranges[within] - distance) > SURFACE_DEPTH
    oblique = abs(wrap_angle(direction + math.pi - normal))
    sharp = face is not None and others.mean() < OTHERS and oblique <= SHARP_OBLIQUE
    sharp = sharp and not (patch.alone and distance * PIXEL < SMALLEST)
    distance = float(np.hypot(*(place - origin)))
    covariance = _covariance(view, direction, distance, normal)
    return Fix(
        view.stamp, view.sensor, patch.pixel, float(place[0]), float(place[1]), covariance, normal,
        distance, patch.peak, bool(sharp),
    )  # fmt: skip


def _surface(ranges: NDArray[np.float64], width: float) -> NDArray[np.intp]:
    """Which of the rays are the surface's: the fullest bin, or a nearer one that is full too."""
    bins = np.floor(ranges / width).astype(int)
    numbers, counts = np.unique(bins, return_counts=True)
    fullest = int(np.argmax(counts))
    nearer = np.flatnonzero(counts[:fullest] >= NEARER_SHARE * len(ranges))
    number = numbers[nearer[0] if len(nearer) else fullest]
    return np.flatnonzero(bins == number)


def _on_face(
    middle: Points, hits: Points, origin: Points, direction: float
) -> tuple[Points, float] | None:
    """The place (2,) [m] where the ray meets the wall's line, and the wall's normal [rad].

    None where too few points lie on one line.
    """
    near = hits[np.hypot(*(hits - middle).T) <= FACE_REACH]
    if len(near) < LEAST_FACE:
        return None
    center = near.mean(axis=0)
    values, vectors = np.linalg.eigh(np.cov((near - center).T))
    normal = vectors[:, 0]
    ray = np.array([math.cos(direction), math.sin(direction)])
    towards = float(normal @ ray)
    if values[0] > 0.25 * values[1] or abs(towards) < GRAZING:
        return None
    distance = float(normal @ (center - origin)) / towards
    place = origin + distance * ray
    if np.hypot(*(place - middle)) > FACE_REACH:
        place = middle
    normal = -normal if towards > 0 else normal
    return place, math.atan2(normal[1], normal[0])


def _covariance(
    view: View, direction: float, distance: float, normal: float
) -> tuple[float, float, float, float]:
    """Of the place: along the wall by the bearing, across it by the range."""
    blur = TIME_SIGMA * abs(view.turn_rate)
    obliquity = max(0.3, abs(math.cos(direction - normal)))
    along = distance * math.hypot(BEARING_SIGMA, blur) / obliquity
    across = RANGE_SIGMA + RANGE_SIGMA_SHARE * distance
    placed = POSE_SIGMA**2 + (TIME_SIGMA * view.speed) ** 2
    cos, sin = math.cos(normal), math.sin(normal)
    axes = np.array([[cos, -sin], [sin, cos]])  # across the wall, along it
    xx, xy, yx, yy = (axes @ np.diag([across**2, along**2]) @ axes.T).ravel()
    return float(xx + placed), float(xy), float(yx), float(yy + placed)


def _wrapped(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    return (angles + math.pi) % (2.0 * math.pi) - math.pi
