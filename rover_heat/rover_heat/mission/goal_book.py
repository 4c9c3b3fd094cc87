"""Goals that were reached, and goals that failed: what is not to be chosen now."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_heat.planning.types import GoalKind, HeatGoal

Points = NDArray[np.float64]
FAILED_SECONDS = 60.0  # [s] for which a goal is not chosen after its first failure
FAILED_RADIUS = 0.15  # [m] around what it was about
MOST_VIEWS = 2  # views in vain, after which a face is given up


@dataclass
class _Failure:
    x: float  # [m]
    y: float  # [m]
    until: float  # [s]; inf after the second


@dataclass
class GoalBook:
    cell: float  # [m]
    placement: int  # [cells] around a frontier that a visit makes known
    _failures: list[_Failure] = field(default_factory=list)
    _visited: list[tuple[float, float]] = field(default_factory=list)
    _tries: dict[tuple[int, int], int] = field(default_factory=dict)  # by face [cells]

    def memory(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "failures": [dict(vars(failure)) for failure in self._failures],
            "visited": list(self._visited),
            "tries": [[*key, tries] for key, tries in self._tries.items()],
        }

    def restore(self, memory: dict[str, Any]) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        self._failures = [_Failure(**each) for each in memory["failures"]]
        self._visited = [(float(x), float(y)) for x, y in memory["visited"]]
        self._tries = {(int(row), int(col)): int(n) for row, col, n in memory["tries"]}

    def reached(self, goal: HeatGoal) -> None:
        """The robot has looked from there: what there was to see has been seen."""
        if goal.kind is GoalKind.FRONTIER:
            self._visited.append((goal.x, goal.y))

    def failed(self, time: float, goal: HeatGoal) -> None:
        """The robot did not get there."""
        for failure in self._failures:
            if math.dist((failure.x, failure.y), (goal.x, goal.y)) < FAILED_RADIUS:
                failure.until = math.inf
                return
        self._failures.append(_Failure(goal.x, goal.y, time + FAILED_SECONDS))

    def forgive(self, goal: HeatGoal) -> None:
        """Nothing else is left: it is tried once more."""
        for failure in self._failures:
            if math.dist((failure.x, failure.y), (goal.x, goal.y)) < FAILED_RADIUS:
                failure.until = -math.inf

    def viewed_in_vain(self, faces: Points) -> Points:
        """Faces (n, 2) [m] that a view left unexamined; those of them to be given up."""
        given_up = []
        for x, y in faces.tolist():
            key = (math.floor(x / self.cell), math.floor(y / self.cell))
            self._tries[key] = self._tries.get(key, 0) + 1
            if self._tries[key] >= MOST_VIEWS:
                given_up.append((x, y))
        return np.array(given_up, float).reshape(-1, 2)

    @property
    def visited(self) -> Points:
        """(n, 2) [m] Frontiers that were observed."""
        return np.array(self._visited, float).reshape(-1, 2)

    def known(self) -> Points:
        """(n, 3) [m] x, y, radius around them."""
        radius = np.full((len(self._visited), 1), self.placement * self.cell)
        return np.hstack([self.visited, radius])

    def not_now(self, time: float) -> Points:
        """(n, 3) [m] x, y, radius of goals not to be chosen at a time [s]."""
        discs = [(f.x, f.y, FAILED_RADIUS) for f in self._failures if f.until > time]
        return np.array(discs, float).reshape(-1, 3)
