"""Where to stand before a source, and before a ramp."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rover_common.geometry import Pose
from rover_heat.config import HeatConfig
from rover_heat.planning.site import Site
from rover_heat.planning.types import StandOff
from rover_heat.ramp.estimate import Ramp
from rover_heat.thermal.sources import Group

FARTHER = 0.05  # [m] beyond the stand-off, where there is no room at it
ASIDE = math.radians(20.0)  # off the wall's normal
REACH = 0.05  # [m] to the nearest drivable cell
BEFORE_FOOT = (0.50, 0.40, 0.60)  # [m] before the foot of a ramp, the wanted one first


def stand_offs(site: Site, source: Group, config: HeatConfig) -> tuple[StandOff, ...]:
    """Poses with room that can be reached and see the source, the wanted one first."""
    found = []
    place = np.array([[source.x, source.y]])
    normal = np.array([math.cos(source.normal), math.sin(source.normal)])
    for pose in _candidates(source, config):
        seconds = site.seconds_to(pose.x, pose.y, REACH)
        start = np.array([[pose.x, pose.y]])
        before_wall = place + 2 * REACH * normal
        if math.isfinite(seconds) and site.in_sight(start, before_wall)[0]:
            found.append(StandOff(pose, seconds))
    return tuple(found)


def _candidates(source: Group, config: HeatConfig) -> Iterator[Pose]:
    for angle in (0.0, ASIDE, -ASIDE):
        for distance in (config.stand_off, config.stand_off + FARTHER):
            direction = source.normal + angle
            x = source.x + distance * math.cos(direction)
            y = source.y + distance * math.sin(direction)
            yield Pose(x, y, math.atan2(source.y - y, source.x - x))


def approach(site: Site, ramp: Ramp) -> StandOff:
    """Where the climb begins; inf seconds when it is out of reach."""
    poses = [ramp.before_foot(distance) for distance in BEFORE_FOOT]
    stands = [StandOff(pose, site.seconds_to(pose.x, pose.y, REACH)) for pose in poses]
    reachable = [stand for stand in stands if math.isfinite(stand.seconds)]
    return reachable[0] if reachable else stands[0]
