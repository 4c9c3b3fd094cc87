"""The pose of a robot that may be anywhere: every candidate is tried on the map."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_navigation.localization.distance_field import DistanceField

POINTS = 60  # of the scan that are tried
NEAR, NEAR_STEP = 0.5, 0.05  # [m] around the expected place, and [m] between candidates
NEAR_TURN, NEAR_TURN_STEP = 0.6, 0.05  # [rad]
FAR_STEP = 2  # [cells] between candidates anywhere
FAR_TURN_STEP = math.radians(5.0)
MISS = 0.3  # [m] a point farther than this from all walls is no worse than one at this distance
# [m per m] of mean distance that a candidate must be better by, to be taken for one that is nearer
# to the expected place: mazes look alike in several places.
FARTHER = 0.005


def near_candidates(expected: Pose) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places (n, 2) [m] and yaws (m,) [rad] around the expected pose."""
    steps = np.arange(-NEAR, NEAR + NEAR_STEP / 2, NEAR_STEP)
    x, y = np.meshgrid(expected.x + steps, expected.y + steps)
    turns = np.arange(-NEAR_TURN, NEAR_TURN + NEAR_TURN_STEP / 2, NEAR_TURN_STEP)
    return np.stack([x.ravel(), y.ravel()], axis=1), expected.yaw + turns


def all_candidates(
    field: DistanceField, free: NDArray[np.bool_], expected: Pose
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places (n, 2) [m] on free cells (rows, cols) and yaws (m,) [rad] all around."""
    some = np.zeros_like(free)
    some[::FAR_STEP, ::FAR_STEP] = free[::FAR_STEP, ::FAR_STEP]
    x, y = field.geometry.center_of(*np.nonzero(some))
    return np.stack([x, y], axis=1), expected.yaw + np.arange(0.0, 2 * math.pi, FAR_TURN_STEP)


def best_candidate(
    points: NDArray[np.float64],
    field: DistanceField,
    expected: Pose,
    places: NDArray[np.float64],
    yaws: NDArray[np.float64],
) -> Pose:
    """The candidate at which the points (n, 2) [m] of base_footprint lie nearest to walls."""
    some = points[:: max(1, len(points) // POINTS)]
    away = FARTHER * np.hypot(places[:, 0] - expected.x, places[:, 1] - expected.y)
    best, least = expected, math.inf
    for yaw in yaws.tolist():
        cos, sin = math.cos(yaw), math.sin(yaw)
        x = places[:, :1] + cos * some[:, 0] - sin * some[:, 1]
        y = places[:, 1:] + sin * some[:, 0] + cos * some[:, 1]
        misfit = np.minimum(field.at(x, y), MISS).mean(axis=1) + away
        index = int(np.argmin(misfit))
        if misfit[index] < least:
            least = float(misfit[index])
            best = Pose(float(places[index, 0]), float(places[index, 1]), yaw)
    return best
