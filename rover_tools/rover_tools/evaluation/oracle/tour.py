"""The time that a rover would need that knew the map: the reference for each mission's time.

The oracle drives one round trip from the start: it brings every navigable cell into view, visits
every sample, and comes back. It knows the canyon and all samples beforehand, does not have to react
to anything, and drives the vehicle at its limits.

It is an estimate that is hard to beat, not a proven lower bound. Easier for it than for
a rover:

- it sees all around wherever it passes, as far as perception maps; only walls and rocks block its
  view;
- it drives curves, and turns around in dead ends, without slowing down; it stops for samples only,
  for the time that the arm takes;
- it may drive wherever a cell is navigable, however near the wall.

Harder than at the true optimum:

- the viewpoints and the order of the stops come from heuristics: a shorter tour may exist;
- it moves between cell centres in sixteen directions, at most 2.8 % longer than a straight line;
- it drives to the cell nearest to a sample, though the arm reaches further.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.vehicle import ROVER
from rover_perception.config import PerceptionConfig
from rover_simulator.world.world import World
from rover_tools.evaluation.oracle.ground import OracleGround
from rover_tools.evaluation.oracle.round_trip import RoundTrip
from rover_tools.evaluation.oracle.top_speed import leg_seconds

SIGHT = PerceptionConfig().max_range  # [m] ground beyond is not mapped
ROUNDS = 20  # of moving the viewpoints; fewer have always been enough


@dataclass(frozen=True)
class OracleTour:
    """A round trip that sees all ground and visits all samples."""

    seconds: float  # of the whole trip, pickups included
    metres: float
    path: NDArray[np.float64]  # (n, 2) [m] cell centres along it, the start first and last


def oracle_tour(world: World, sight: float = SIGHT) -> OracleTour:
    """The same world gives the same tour; it takes some seconds for a world of size 1.

    sight [m]: how far ground can be brought into view.
    """
    home = (world.start.x, world.start.y)
    ground = OracleGround(world.navigable, home)
    start = ground.nearest(home)
    samples = [ground.nearest((float(x), float(y))) for x, y in world.samples]
    trip = RoundTrip(ground, ground.sight(sight), start, samples)
    trip.add_viewpoints()
    for _ in range(ROUNDS):
        before = trip.metres()
        trip.drop_or_move_viewpoints()
        trip.order()
        if trip.metres() > before - 0.5:
            break
    legs = trip.metres_between_stands()
    seconds = sum(map(leg_seconds, legs)) + ROVER.pickup_seconds * len(samples)
    return OracleTour(seconds, sum(legs), ground.centers[trip.path()])
