"""Options of the command line that say which world is simulated, and how.

Declared once, for `rover sim` and for every other command that simulates. Nothing here imports more
than click, so that help and completion stay fast.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from rover_common.command_line import Real, Whole

if TYPE_CHECKING:
    from rover_simulator.world.world import World

F = TypeVar("F", bound=Callable[..., Any])

FPS = 25.0  # [1/s] frames per simulated second unless others are asked for
MOST_FPS = 50.0  # [1/s] a frame has at least one step of the physics
SIZES = (0.2, 2.0)  # smaller canyons have no room for six samples, larger ones reach the border
LONGEST = 100_000.0  # [s]

SEED = Whole(min=0)
FILE = click.Path(exists=True, dir_okay=False, path_type=Path)
FOLDER = click.Path(exists=True, file_okay=False, path_type=Path)


@dataclass(frozen=True)
class WorldOptions:
    """Which world: a generated one, unless there is a map or a folder."""

    seed: int
    size: float = 1.0  # of a generated canyon, 1 as large as the original
    map_file: Path | None = None
    folder: Path | None = None

    def load(self) -> World:
        """Raises TruthError or WorldError."""
        from rover_simulator.world.generator import generate_world, world_of_map
        from rover_simulator.world.world import World

        if self.folder is not None:
            return World.load(self.folder)
        if self.map_file is not None:
            return world_of_map(self.map_file, self.seed)
        return generate_world(self.seed, self.size)


def seed_option(text: str) -> Callable[[F], F]:
    return click.option("--seed", type=SEED, default=1, show_default=True, metavar="N", help=text)


def size_option(default: float = 1.0) -> Callable[[F], F]:
    return click.option(
        "--size", type=Real(*SIZES), default=default, show_default=True, metavar="X",
        help="Size of a generated canyon; 1 is as large as the original.",
    )  # fmt: skip


def map_option(text: str) -> Callable[[F], F]:
    return click.option("--map", "map_file", type=FILE, metavar="PNG", help=text)


def fps_option(default: float = FPS) -> Callable[[F], F]:
    return click.option(
        "--fps", type=Real(0.0, MOST_FPS, min_open=True), default=default, show_default=True,
        metavar="N",
        help="Frames per simulated second, made 50 over a whole number.",
    )  # fmt: skip


def time_limit_option(default: float | None, text: str) -> Callable[[F], F]:
    return click.option(
        "--time-limit", type=Real(0.0, LONGEST, min_open=True), default=default,
        show_default=default is not None, metavar="S", help=text,
    )  # fmt: skip


def world_options(function: F, size: float = 1.0) -> F:
    """--seed, --size, --map and --world, which reach the function as `world`, a WorldOptions."""

    @seed_option("Seed of the generated canyon, or of a map's samples.")
    @size_option(size)
    @map_option("A map of 200 x 200 pixels instead; white is ground.")
    @click.option("--world", "folder", type=FOLDER, metavar="DIR",
                  help="A world's folder instead: map.png, world.yaml.")  # fmt: skip
    @functools.wraps(function)
    def with_world(
        *, seed: int, size: float, map_file: Path | None, folder: Path | None, **others: Any
    ) -> Any:
        if map_file is not None and folder is not None:
            raise click.UsageError("--map and --world exclude each other.")
        return function(world=WorldOptions(seed, size, map_file, folder), **others)

    return with_world  # type: ignore[return-value]
