"""One mission to run, as plain data that can travel to another machine."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.ground_truth import load_truth
from rover_simulator.world.generator import generate_world, world_on_ground
from rover_simulator.world.world import World

GENERATED = "generated"  # the group of canyons drawn from a seed


@dataclass(frozen=True)
class Ground:
    """The navigable cells of a map, packed."""

    name: str
    shape: tuple[int, int]
    bits: bytes

    @classmethod
    def load(cls, path: Path) -> Ground:
        """Raises TruthError."""
        cells = load_truth(path)
        rows, cols = cells.shape
        return cls(path.stem, (rows, cols), np.packbits(cells).tobytes())

    @property
    def cells(self) -> NDArray[np.bool_]:
        rows, cols = self.shape
        bits = np.unpackbits(np.frombuffer(self.bits, np.uint8), count=rows * cols)
        return bits.reshape(self.shape).astype(bool)


@dataclass(frozen=True)
class Job:
    """A world, a seed and a strategy, with how to simulate them."""

    strategy: str
    seed: int  # of the canyon, or of a map's samples
    ground: Ground | None  # None: a generated canyon
    size: float  # of a generated canyon, 1 as large as the original
    fps: float
    time_limit: float  # [s] simulated

    @property
    def group(self) -> str:
        """Of the worlds that are counted together."""
        return GENERATED if self.ground is None else self.ground.name

    @property
    def world_name(self) -> str:
        """As the world calls itself."""
        return f"seed-{self.seed}" if self.ground is None else f"{self.ground.name}-{self.seed}"

    @property
    def name(self) -> str:
        """Of its files in the result folder."""
        return f"{self.group}-{self.seed}-{self.strategy}"

    def world(self) -> World:
        if self.ground is None:
            return generate_world(self.seed, self.size)
        return world_on_ground(self.ground.cells, self.ground.name, self.seed)

    def settings(self) -> dict[str, Any]:
        """All that the result depends on, for its file."""
        ground = self.ground
        return {
            "group": self.group,
            "strategy": self.strategy,
            "seed": self.seed,
            "map_sha256": None if ground is None else hashlib.sha256(ground.bits).hexdigest(),
            "size": self.size if ground is None else None,
            "fps": self.fps,
            "time_limit": self.time_limit,
        }


def make_jobs(
    worlds: Sequence[int],
    ground: Ground | None,
    seeds: Sequence[int],
    strategies: Sequence[str],
    *,
    size: float,
    fps: float,
    time_limit: float,
) -> list[Job]:
    """Each strategy in each generated world, then on the map with samples drawn by each seed."""
    places: list[tuple[Ground | None, int]] = [(None, seed) for seed in worlds]
    if ground is not None:
        places += [(ground, seed) for seed in seeds]
    return [
        Job(strategy, seed, place, size, fps, time_limit)
        for (place, seed), strategy in product(places, strategies)
    ]
