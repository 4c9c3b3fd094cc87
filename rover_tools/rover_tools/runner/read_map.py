"""Read the world map of the running graph."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rover_common.errors import RoverError
from rover_common.map_encoding import EDGE, UNKNOWN, navigable_cells
from rover_common.types import GridMap, RockTrack
from rover_tools.evaluation.map_files import draw_map
from rover_tools.evaluation.results import Result
from rover_tools.runner.domain import chosen_domain
from rover_tools.runner.node_watch import GraphWatch

USUAL_DOMAIN = 0  # of ROS, where none is named
ROCK_SECONDS = 1.0  # [s] for the rocks, which are latched as the map is


class NoMapError(RoverError):
    """No map came in time."""


@dataclass(frozen=True)
class ReadMap:
    """The newest map and what rocks are on it."""

    grid: GridMap
    rocks: tuple[RockTrack, ...]

    def result(self) -> Result:
        """Size and counts."""
        cells = self.grid.cells
        return {
            "width": cells.shape[1],
            "height": cells.shape[0],
            "resolution": self.grid.resolution,
            "unknown": int(np.count_nonzero(cells == UNKNOWN)),
            "free": int(np.count_nonzero(navigable_cells(cells))),
            "edge": int(np.count_nonzero(cells == EDGE)),
            "occupied": int(np.count_nonzero(cells > EDGE)),
            "rocks": len(self.rocks),
            "rocks_found": [{"x": round(r.x, 3), "y": round(r.y, 3)} for r in self.rocks],
        }

    def draw(self, file: Path) -> None:
        """As PNG."""
        draw_map(file, self.grid, np.empty((0, 2)), self.rocks, None, None, "world map")


def read_map(seconds: float) -> ReadMap:
    """Wait so long [s] for the latched map in the domain of ROS_DOMAIN_ID.

    Raises NoMapError and DomainError.
    """
    domain = chosen_domain()
    domain_id = USUAL_DOMAIN if domain is None else domain
    with GraphWatch(domain_id) as watch:
        grid = watch.wait_map(0, seconds)
        if grid is None:
            raise NoMapError(
                f"no map came within {seconds:g} s in domain {domain_id}; "
                "ROS_DOMAIN_ID names the domain of a running graph"
            )
        return ReadMap(grid, watch.wait_rocks(ROCK_SECONDS))
