"""One heat mission to run, as plain data that can travel to another machine."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import Maze
from rover_tools.evaluation.heat_setup import HeatSetup


@dataclass(frozen=True)
class HeatJob:
    """A maze, a seed, and what runs in it."""

    setup: HeatSetup
    seed: int  # of a generated maze, and of the sensors' noise
    family: str  # of a generated maze
    maze: Maze | None = None  # instead of a generated one

    @property
    def group(self) -> str:
        """Of the mazes that are counted together."""
        return self.family if self.maze is None else self.maze.name

    @property
    def world_name(self) -> str:
        """As the maze calls itself."""
        return f"{self.family}-{self.seed}" if self.maze is None else self.maze.name

    @property
    def name(self) -> str:
        """Of its files in the result folder."""
        return f"{self.group}-{self.seed}-{self.setup.label}"

    def world(self) -> Maze:
        """Raises MazeError."""
        return self.maze or generate_maze(self.seed, self.family)

    def settings(self) -> dict[str, Any]:
        """All that the result depends on, for its file."""
        maze = None if self.maze is None else hashlib.sha256(repr(self.maze).encode()).hexdigest()
        return {
            "group": self.group,
            "strategy": self.setup.label,
            "seed": self.seed,
            "maze_sha256": maze,
            "changed": self.setup.settings(),
        }


def make_heat_jobs(
    worlds: Sequence[int], family: str, maze: Maze | None, setups: Sequence[HeatSetup]
) -> list[HeatJob]:
    """Each setup in each maze; in a maze that is given, the seeds draw the sensors' noise."""
    return [HeatJob(setup, seed, family, maze) for seed, setup in product(worlds, setups)]
