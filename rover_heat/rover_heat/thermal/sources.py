"""From fixes to sources: fixes of one place and one side of a wall belong together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans2

from rover_heat.config import HeatConfig
from rover_heat.thermal.fix import Fix

SAME_SIDE = math.radians(60.0)  # between the normals of fixes of one group
SIGMA_LEAST = 0.02  # [m] errors that all fixes of a source share do not average out
# A group this near to another one, in units of the group distance, with so many times fewer fixes
SATELLITE_DISTANCE, SATELLITE_SHARE = 1.5, 4
KMEANS_CLUSTERS = 3  # where no number is given
SEED = 0  # of the first guess of k-means


@dataclass(frozen=True)
class Group:
    """Fixes that belong together: a source, as far as is known."""

    x: float  # [m] map frame, on the wall
    y: float  # [m]
    covariance: tuple[float, float, float, float]  # [m^2] xx, xy, yx, yy
    normal: float  # [rad] of the wall on the warm side
    observations: int
    nearest: float  # [m] range of the nearest fix
    peak: float  # [K] greatest excess


def find_suspects(
    fixes: Sequence[Fix], sources: Sequence[Group], config: HeatConfig
) -> NDArray[np.float64]:
    """Fixes (n, 2) [m] that are too few to be a source: their places are to be observed again."""
    places = np.array([(fix.x, fix.y) for fix in fixes]).reshape(-1, 2)
    known = np.array([(source.x, source.y) for source in sources]).reshape(-1, 2)
    away = np.hypot(*(places[:, None] - known[None]).transpose(2, 0, 1))
    return places[(away > SATELLITE_DISTANCE * config.group_distance).all(axis=1)]


def find_sources(fixes: Sequence[Fix], config: HeatConfig) -> tuple[Group, ...]:
    """The sources, the best observed first; none where there are no fixes."""
    if not fixes:
        return ()
    table = _Table(fixes)
    by_kmeans = config.clustering == "kmeans"
    members = _kmeans(table, config) if by_kmeans else _groups(table, config)
    groups = [_group(table, which) for which in members]
    groups.sort(key=lambda group: -group.observations)
    if not by_kmeans:
        groups = _without_satellites(groups, config.group_distance)
    return tuple(groups[: config.clusters or None])


def _without_satellites(groups: list[Group], distance: float) -> list[Group]:
    """Without those that are a greater one's worst fixes; the greatest come first."""
    kept: list[Group] = []
    for group in groups:
        if not any(_is_satellite(group, other, distance) for other in kept):
            kept.append(group)
    return kept


def _is_satellite(group: Group, other: Group, distance: float) -> bool:
    away = math.dist((group.x, group.y), (other.x, other.y))
    turned = math.cos(group.normal - other.normal)
    few = group.observations * SATELLITE_SHARE <= other.observations
    return few and away <= SATELLITE_DISTANCE * distance and turned >= math.cos(SAME_SIDE)


class _Table:
    """Fixes as arrays (n,)."""

    def __init__(self, fixes: Sequence[Fix]) -> None:
        self.place = np.array([(fix.x, fix.y) for fix in fixes])
        self.normal = np.array([fix.normal for fix in fixes])
        self.covariance = np.array([fix.covariance for fix in fixes]).reshape(-1, 2, 2)
        self.weight = 1.0 / np.trace(self.covariance, axis1=1, axis2=2)
        self.range = np.array([fix.range for fix in fixes])
        self.peak = np.array([fix.peak for fix in fixes])


def _groups(table: _Table, config: HeatConfig) -> list[NDArray[np.intp]]:
    """One after the other, around the fix that the most evidence lies near to."""
    near = _beside(table, config.group_distance)
    free = np.ones(len(near), bool)
    groups = []
    while free.any():
        evidence = np.where(free, near @ (table.weight * free), -1.0)
        members = near[int(np.argmax(evidence))] & free
        free &= ~members
        if np.count_nonzero(members) >= config.group_least:
            groups.append(np.flatnonzero(members))
    return groups


def _beside(table: _Table, distance: float) -> NDArray[np.bool_]:
    """(n, n) Whether two fixes lie within a distance [m], on one side of a wall."""
    away = table.place[:, None] - table.place[None]
    turned = np.cos(table.normal[:, None] - table.normal[None])
    return np.asarray(((away**2).sum(axis=2) <= distance**2) & (turned >= math.cos(SAME_SIDE)))


def _kmeans(table: _Table, config: HeatConfig) -> list[NDArray[np.intp]]:
    """As many clusters as wanted, and never more than there are places."""
    places = len(np.unique(table.place, axis=0))
    count = min(config.clusters or KMEANS_CLUSTERS, places)
    if count == 1:
        return [np.arange(len(table.place))]
    _, labels = kmeans2(table.place, count, minit="++", seed=np.random.default_rng(SEED))
    clusters = [np.flatnonzero(labels == number) for number in range(count)]
    return [cluster for cluster in clusters if len(cluster)]


def _group(table: _Table, members: NDArray[np.intp]) -> Group:
    weight = table.weight[members] / table.weight[members].sum()
    x, y = weight @ table.place[members]
    spread = np.einsum("n,nij->ij", weight**2, table.covariance[members])
    covariance = spread + SIGMA_LEAST**2 * np.eye(2)
    normal = table.normal[members]
    return Group(
        x=float(x),
        y=float(y),
        covariance=tuple(map(float, covariance.ravel())),  # type: ignore[arg-type]
        normal=math.atan2(float(weight @ np.sin(normal)), float(weight @ np.cos(normal))),
        observations=len(members),
        nearest=float(table.range[members].min()),
        peak=float(table.peak[members].max()),
    )
