"""A maze: walls, heat sources, ramp, start, and the errors drawn for the robot's sensors.

All positions are in the world frame: x east, y north, the field's south-west corner at (0, 0).
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import yaml

from rover_common.errors import RoverError
from rover_common.geometry import Pose

WALL_THICKNESS = 0.005  # [m] acrylic, by the challenge's drawing
WALL_HEIGHT = 0.47  # [m]


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
        path.write_text(yaml.safe_dump(_plain(asdict(self)), sort_keys=False))

    @classmethod
    def load(cls, path: Path) -> Maze:
        """The same maze again; raises MazeError."""
        try:
            return _maze_of(yaml.safe_load(path.read_text()))
        except (OSError, KeyError, TypeError, ValueError, yaml.YAMLError) as error:
            raise MazeError(f"{path}: {error}") from error


def _maze_of(data: dict[str, Any]) -> Maze:
    errors = data["errors"] | {
        name: tuple(map(float, data["errors"][name])) for name in ("thermal_offsets", "gyro_bias")
    }
    return Maze(
        name=str(data["name"]),
        width=float(data["width"]),
        height=float(data["height"]),
        walls=tuple(Wall(*map(float, ends)) for ends in data["walls"]),
        sources=tuple(HeatSource(**source) for source in data["sources"]),
        ramp=None if data["ramp"] is None else Ramp(**data["ramp"]),
        start=Pose(**data["start"]),
        air=float(data["air"]),
        errors=SensorErrors(**errors),
    )


def _plain(data: dict[str, Any]) -> dict[str, Any]:
    """A wall as its four numbers."""
    return data | {"walls": [list(wall.values()) for wall in data["walls"]]}
