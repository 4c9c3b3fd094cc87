"""Poses from which the thermal sensors examine faces that no frame has shown yet."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, wrap_angle
from rover_heat.config import HeatConfig, thermal_yaw
from rover_heat.planning.faces import Faces
from rover_heat.planning.site import Site
from rover_heat.planning.types import LOOK_SECONDS, GoalKind, HeatGoal
from rover_heat.thermal.coverage import FIELD, OBLIQUE, REACH
from rover_navigation.burger_scale import BURGER_SCALE

Points = NDArray[np.float64]
SPACING = 0.15  # [m] between places that are tried
# A view has to work out when the robot stands a little aside: margins on what counts.
MARGIN_RANGE, MARGIN_ANGLE = 0.1, math.radians(5.0)  # [m], [rad]
BINS = 72  # directions of view
LEAST = 3  # [cells] of face that are worth a view: a patch of heat is wider
MOST = 8  # goals that are handed out
APART = 0.3  # [m] between the places of two of them


@dataclass(frozen=True)
class Sights:
    """Which face (index) is seen from which place, and in which direction; all (n,)."""

    place: NDArray[np.intp]  # index into `nodes`
    face: NDArray[np.intp]
    bearing: NDArray[np.float64]  # [rad] map frame
    nodes: NDArray[np.intp]  # of the places


def find_sights(site: Site, faces: Faces) -> Sights:
    """From reachable places to all faces that a sensor could examine there."""
    nodes = _places(site)
    place = site.nodes[nodes]
    away = place[:, None] - faces.points[None]
    ranges = np.hypot(away[..., 0], away[..., 1])
    normal = np.stack([np.cos(faces.normals), np.sin(faces.normals)], axis=1)
    facing = (away * normal[None]).sum(axis=2)
    upright = facing >= math.cos(OBLIQUE - MARGIN_ANGLE) * ranges
    which, face = np.nonzero(upright & (ranges <= REACH - MARGIN_RANGE) & (ranges > 0.0))
    seen = site.in_sight(place[which], faces.points[face])
    which, face = which[seen], face[seen]
    back = -away[which, face]
    return Sights(which, face, np.arctan2(back[:, 1], back[:, 0]), nodes)


def view_goals(
    site: Site, faces: Faces, sights: Sights, pose: Pose, sensors: tuple[int, ...],
    config: HeatConfig,
) -> list[HeatGoal]:  # fmt: skip
    """The best views of what is left, each with faces of its own; the best first."""
    left = ~faces.examined
    goals: list[HeatGoal] = []
    axes = [thermal_yaw(config, sensor) for sensor in sensors]
    for _ in range(MOST if axes else 0):
        goal = _best(site, faces, sights, pose, axes, left)
        if goal is None:
            break
        goals.append(goal[0])
        left = left.copy()
        left[goal[1]] = False
    return goals


def _best(
    site: Site, faces: Faces, sights: Sights, pose: Pose, axes: list[float],
    left: NDArray[np.bool_],
) -> tuple[HeatGoal, NDArray[np.intp]] | None:  # fmt: skip
    """The view that examines most per second, and its faces."""
    new = left[sights.face]
    place, bearing = sights.place[new], sights.bearing[new]
    if len(place) == 0:
        return None
    gains = _gains(len(sights.nodes), place, bearing, axes)
    yaws = 2.0 * math.pi * np.arange(BINS) / BINS
    turn = np.abs(np.angle(np.exp(1j * (yaws - pose.yaw))))  # where the robot stands already
    seconds = (
        site.seconds[sights.nodes][:, None]
        + LOOK_SECONDS
        + np.where(
            site.seconds[sights.nodes][:, None] < LOOK_SECONDS,
            turn[None] / BURGER_SCALE.turn_rate,
            0.0,
        )
    )
    rate = np.where(gains >= LEAST, gains / seconds, 0.0)
    best, number = np.unravel_index(int(np.argmax(rate)), rate.shape)
    if rate[best, number] <= 0.0:
        return None
    yaw = wrap_angle(float(yaws[number]))
    own = np.flatnonzero(new)[place == best]
    own = own[_in_fields(sights.bearing[own], yaw, axes)]
    node = int(sights.nodes[best])
    x, y = (float(v) for v in site.nodes[node])
    points = faces.points[np.unique(sights.face[own])]
    middle = points.mean(axis=0)
    return HeatGoal(
        GoalKind.VIEW, Pose(x, y, yaw), float(middle[0]), float(middle[1]),
        float(site.seconds[node]), points,
    ), np.unique(sights.face[own])  # fmt: skip


def _gains(
    places: int, place: NDArray[np.intp], bearing: NDArray[np.float64], axes: list[float]
) -> NDArray[np.float64]:
    """(places, BINS) Faces that the sensors show together at each heading."""
    width = 2.0 * math.pi / BINS
    number = np.round(bearing / width).astype(int) % BINS
    counts = np.bincount(place * BINS + number, minlength=places * BINS).reshape(places, BINS)
    headings = width * np.arange(BINS)
    shown = np.zeros((BINS, BINS), bool)  # bearing, heading
    for axis in axes:
        aside = headings[:, None] - headings[None] - axis
        shown |= np.abs(np.angle(np.exp(1j * aside))) <= FIELD - MARGIN_ANGLE
    return counts.astype(float) @ shown.astype(float)  # of whole numbers: in any order the same


def _in_fields(bearing: NDArray[np.float64], yaw: float, axes: list[float]) -> NDArray[np.bool_]:
    aside = [np.abs(np.angle(np.exp(1j * (bearing - yaw - axis)))) for axis in axes]
    return np.asarray(np.minimum.reduce(aside) <= FIELD - MARGIN_ANGLE)


def _places(site: Site) -> NDArray[np.intp]:
    """Nodes some way apart that can be reached, the soonest reached of each square."""
    nodes = site.with_room(np.flatnonzero(np.isfinite(site.seconds)))
    nodes = nodes[np.argsort(site.seconds[nodes], kind="stable")]
    squares = np.floor(site.nodes[nodes] / SPACING).astype(int)
    _, first = np.unique(squares, axis=0, return_index=True)
    return nodes[np.sort(first)]
