"""A world: which cells are navigable, where samples lie, where the rover starts."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import cv2
import numpy as np
import yaml
from numpy.typing import NDArray

from rover_common.errors import RoverError
from rover_common.geometry import Pose
from rover_common.ground_truth import load_truth
from rover_simulator.world.boulders import Boulder, boulders_of

MAP_NAME, WORLD_NAME = "map.png", "world.yaml"


class WorldError(RoverError, ValueError):
    """The folder of a world cannot be read."""


@dataclass(frozen=True, eq=False)
class World:
    name: str
    navigable: NDArray[np.bool_]  # (200, 200) cells of 1 m, [y, x]
    samples: NDArray[np.float64]  # (n, 2) [m] map frame
    start: Pose

    @cached_property
    def boulders(self) -> list[Boulder]:
        """Small rocks in the open: the small holes of the map."""
        return boulders_of(self.navigable, zlib.crc32(self.navigable.tobytes()))

    def save(self, folder: Path) -> None:
        """Write map.png and world.yaml into the folder."""
        folder.mkdir(parents=True, exist_ok=True)
        cv2.imwrite(str(folder / MAP_NAME), self.navigable.astype(np.uint8) * 255)
        description = {
            "name": self.name,
            "start": {"x": self.start.x, "y": self.start.y, "yaw": self.start.yaw},
            "samples": [[float(x), float(y)] for x, y in self.samples],
        }
        (folder / WORLD_NAME).write_text(yaml.safe_dump(description, sort_keys=False))

    @classmethod
    def load(cls, folder: Path) -> World:
        """Raises TruthError for its map, WorldError for its description."""
        navigable = load_truth(folder / MAP_NAME)
        try:
            description = yaml.safe_load((folder / WORLD_NAME).read_text())
            start = description["start"]
            return cls(
                str(description["name"]),
                navigable,
                np.array(description["samples"], float).reshape(-1, 2),
                Pose(float(start["x"]), float(start["y"]), float(start["yaw"])),
            )
        except (OSError, KeyError, TypeError, ValueError, yaml.YAMLError) as error:
            raise WorldError(f"{folder / WORLD_NAME}: {error}") from error
