"""What is true of a heat mission in the simulator, for its report; none of a real robot's."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from burger_simulator.truth import Launch, Truth
from burger_simulator.truth_file import read_truth
from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose, compose, distance_between
from rover_tools.report.heat_log import ORIGIN

MAZE, TRUTH = "maze.yaml", "truth.jsonl"


@dataclass(frozen=True)
class HeatTruth:
    maze: Maze | None = None
    ticks: Sequence[Truth] = field(default_factory=tuple)

    @classmethod
    def load(cls, folder: Path) -> HeatTruth:
        """Of a result folder; nothing where it holds none. Raises MazeError."""
        if not ((folder / MAZE).is_file() and (folder / TRUTH).is_file()):
            return NO_TRUTH
        return cls(Maze.load(folder / MAZE), read_truth(folder / TRUTH))

    @property
    def map_in_world(self) -> Pose:
        """The map's frame, which begins where the robot starts."""
        return ORIGIN if self.maze is None else self.maze.start

    @property
    def launches(self) -> tuple[Launch, ...]:
        return self.ticks[-1].launches if self.ticks else ()

    def error_of(self, stamp: int, pose: Pose) -> float | None:
        """[m] of a pose in the map at a stamp [ns]; None where the truth is not known."""
        time, after = stamp * 1e-9, bisect_left(self._times, stamp * 1e-9)
        if not 0 < after < len(self.ticks):
            return None
        first, last = self.ticks[after - 1], self.ticks[after]
        share = (time - first.time) / (last.time - first.time)
        x = first.pose.x + share * (last.pose.x - first.pose.x)
        y = first.pose.y + share * (last.pose.y - first.pose.y)
        return distance_between(Pose(x, y, 0.0), compose(self.map_in_world, pose))

    @cached_property
    def _times(self) -> list[float]:
        return [tick.time for tick in self.ticks]


NO_TRUTH = HeatTruth()
