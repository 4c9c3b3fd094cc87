"""A world: which cells are navigable, where samples lie, where the rover starts."""

from __future__ import annotations

import math
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
from rover_common.grid import WORLD
from rover_common.ground_truth import load_truth
from rover_common.whole_file import write_whole
from rover_common.yaml_file import YamlFileError, read_yaml
from rover_simulator.world.boulders import Boulder, boulders_of

MAP_NAME, WORLD_NAME = "map.png", "world.yaml"
MOST_SAMPLES = 100  # the original has six; each costs a shape in the scene
LONGEST_NAME = 100


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

    def is_navigable(self, x: float, y: float) -> bool:
        """Whether the cell of a point [m] is."""
        row, column = math.floor(y), math.floor(x)
        rows, columns = self.navigable.shape
        inside = 0 <= row < rows and 0 <= column < columns
        return inside and bool(self.navigable[row, column])

    def save(self, folder: Path) -> None:
        """Write map.png and world.yaml into the folder."""
        folder.mkdir(parents=True, exist_ok=True)
        picture = cv2.imencode(".png", self.navigable.astype(np.uint8) * 255)[1]
        write_whole(folder / MAP_NAME, picture.tobytes())
        description = {  # a file that is cut lacks its start
            "name": self.name,
            "samples": [[float(x), float(y)] for x, y in self.samples],
            "start": {"x": self.start.x, "y": self.start.y, "yaw": self.start.yaw},
        }
        write_whole(folder / WORLD_NAME, yaml.safe_dump(description, sort_keys=False))

    @classmethod
    def load(cls, folder: Path) -> World:
        """Raises TruthError for its map, WorldError for its description."""
        navigable = load_truth(folder / MAP_NAME)
        file = folder / WORLD_NAME
        try:
            description = read_yaml(file, generated=True)
            start = description["start"]
            world = cls(
                str(description["name"])[:LONGEST_NAME],
                navigable,
                np.array([(x, y) for x, y in description["samples"]], float).reshape(-1, 2),
                Pose(float(start["x"]), float(start["y"]), float(start["yaw"])),
            )
        except YamlFileError as error:
            raise WorldError(str(error)) from error
        except KeyError as error:
            raise WorldError(f"{file}: {error} is missing") from error
        except (TypeError, ValueError) as error:
            raise WorldError(f"{file}: {error}") from error
        problem = _problem(world)
        if problem:
            raise WorldError(f"{file}: {problem}")
        return world


def _problem(world: World) -> str:
    """Why nothing can drive in such a world; empty when something can."""
    start, samples = world.start, world.samples
    if not (WORLD.contains(start.x, start.y) and world.navigable[int(start.y), int(start.x)]):
        return f"no ground at the start, x = {start.x:g}, y = {start.y:g}"
    if len(samples) > MOST_SAMPLES:
        return f"{len(samples)} samples, at most {MOST_SAMPLES}"
    for x, y in samples:
        if not WORLD.contains(x, y):
            return f"a sample off the map, x = {x:g}, y = {y:g}"
    if len(np.unique(samples, axis=0)) < len(samples):
        return "two samples at one place"
    return ""
