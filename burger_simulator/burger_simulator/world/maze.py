"""A maze: walls, heat sources, ramp, start, and the errors drawn for the robot's sensors.

All positions are in the world frame: x east, y north, the field's south-west corner at (0, 0).
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any, TypeVar

import yaml

from rover_common.errors import RoverError
from rover_common.geometry import Pose
from rover_common.whole_file import write_whole
from rover_common.yaml_file import YamlFileError, read_yaml

WALL_THICKNESS = 0.005  # [m] acrylic, by the challenge's drawing
WALL_HEIGHT = 0.47  # [m]
# Of a file; those of the challenge are below a tenth of it.
LARGEST, MOST_WALLS, MOST_SOURCES = 50.0, 1000, 100  # [m], and numbers
LONGEST_NAME = 100

T = TypeVar("T")


class MazeError(RoverError, ValueError):
    """A maze's file cannot be read, or no maze of a family has been found."""


@dataclass(frozen=True)
class Wall:
    """An upright panel, by the centre line of its base."""

    x0: float  # [m]
    y0: float  # [m]
    x1: float  # [m]
    y1: float  # [m]

    @property
    def length(self) -> float:
        return math.hypot(self.x1 - self.x0, self.y1 - self.y0)

    @property
    def yaw(self) -> float:
        """[rad] from its first to its second end."""
        return math.atan2(self.y1 - self.y0, self.x1 - self.x0)


@dataclass(frozen=True)
class HeatSource:
    """A warm patch on a wall's face: `excess` above the air, falling off as a Gaussian."""

    x: float  # [m] on the face
    y: float  # [m]
    normal: float  # [rad] from the face into the open
    height: float  # [m] of its middle
    sigma: float  # [m] of the patch
    excess: float  # [K] at its middle
    both_faces: bool = False  # warm on the wall's other face as well
    at_ramp: bool = False  # the one that is served from the ramp


@dataclass(frozen=True)
class Ramp:
    """Up, flat, and down again, by the challenge's drawing."""

    x: float  # [m] middle of the foot line
    y: float  # [m]
    yaw: float  # [rad] direction of the rise
    corner: str  # of the field: north-east or south-east
    slope_length: float = 0.50  # [m] on the ground, of either slope
    flat_length: float = 0.25  # [m]
    width: float = 0.50  # [m]
    height: float = 0.06  # [m] of the flat part

    @property
    def length(self) -> float:
        """[m] on the ground."""
        return 2.0 * self.slope_length + self.flat_length

    def along_and_across(self, x: float, y: float) -> tuple[float, float]:
        """[m] beyond the foot line, and to the left of the ramp's middle."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        dx, dy = x - self.x, y - self.y
        return cos * dx + sin * dy, -sin * dx + cos * dy

    def height_at(self, x: float, y: float) -> float:
        """[m] above ground, 0 beside the ramp."""
        along, across = self.along_and_across(x, y)
        if abs(across) > self.width / 2:
            return 0.0
        from_end = min(along, self.length - along)
        return self.height * min(1.0, max(0.0, from_end / self.slope_length))


@dataclass(frozen=True)
class SensorErrors:
    """What is constant in one robot and unknown to it."""

    thermal_offsets: tuple[float, float] = (0.0, 0.0)  # [K] of sensor 1 and 2
    gyro_bias: tuple[float, float, float] = (0.0, 0.0, 0.0)  # [rad/s]
    level_pitch: float = 0.0  # [rad] of the inertial unit on its board, nose down positive
    level_roll: float = 0.0  # [rad]
    wheel_separation_scale: float = 1.0  # true over nominal
    wheel_radius_scale: float = 1.0  # true over nominal


@dataclass(frozen=True)
class Maze:
    name: str
    width: float  # [m] of the field, along x
    height: float  # [m] along y
    walls: tuple[Wall, ...]
    sources: tuple[HeatSource, ...]
    ramp: Ramp | None
    start: Pose
    air: float  # [C]
    errors: SensorErrors = field(default_factory=SensorErrors)

    def save(self, path: Path) -> None:
        """Write it as YAML."""
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, yaml.safe_dump(_plain(asdict(self)), sort_keys=False))

    @classmethod
    def load(cls, path: Path) -> Maze:
        """The same maze again; raises MazeError."""
        try:
            maze = _maze_of(read_yaml(path, generated=True))
        except YamlFileError as error:
            raise MazeError(str(error)) from error
        except KeyError as error:
            raise MazeError(f"{path}: {error} is missing") from error
        except (AttributeError, TypeError, ValueError) as error:
            raise MazeError(f"{path}: {error}") from error
        problem = _problem(maze)
        if problem:
            raise MazeError(f"{path}: {problem}")
        return maze


def _problem(maze: Maze) -> str:
    """Why nothing can drive in such a maze; empty when something can."""
    if not (0.0 < maze.width <= LARGEST and 0.0 < maze.height <= LARGEST):
        return f"a field of {maze.width:g} x {maze.height:g} m, at most {LARGEST:g} m"
    if not (0.0 <= maze.start.x <= maze.width and 0.0 <= maze.start.y <= maze.height):
        return f"a start off the field, x = {maze.start.x:g}, y = {maze.start.y:g}"
    for found, most, name in (
        (len(maze.walls), MOST_WALLS, "walls"), (len(maze.sources), MOST_SOURCES, "heat sources"),
    ):  # fmt: skip
        if found > most:
            return f"{found} {name}, at most {most}"
    return ""


def _maze_of(data: dict[str, Any]) -> Maze:
    return Maze(
        name=str(data["name"])[:LONGEST_NAME],
        width=float(data["width"]),
        height=float(data["height"]),
        walls=tuple(Wall(*map(float, ends)) for ends in data["walls"]),
        sources=tuple(_filled(HeatSource, source) for source in data["sources"]),
        ramp=None if data["ramp"] is None else _filled(Ramp, data["ramp"]),
        start=_filled(Pose, data["start"]),
        air=float(data["air"]),
        errors=_filled(SensorErrors, data["errors"]),
    )


def _filled(kind: type[T], data: dict[str, Any]) -> T:
    """A dataclass all of whose fields are there: a file that is cut lacks the last ones."""
    values = {}
    for each in fields(kind):  # type: ignore[arg-type]
        value = data[each.name]
        values[each.name] = tuple(map(float, value)) if isinstance(value, list) else value
        if each.type == "float":
            values[each.name] = float(value)
    return kind(**values)


def _plain(data: dict[str, Any]) -> dict[str, Any]:
    """A wall as its four numbers."""
    return data | {"walls": [list(wall.values()) for wall in data["walls"]]}
