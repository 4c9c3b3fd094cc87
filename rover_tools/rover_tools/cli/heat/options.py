"""In which maze a heat mission runs, with which parameters, on which variant of the robot."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from rover_common.command_line import Real
from rover_simulator.options import FILE
from rover_tools.cli.options import F, NamesType

if TYPE_CHECKING:
    from burger_simulator.world.maze import Maze
    from rover_tools.evaluation.heat_setup import HeatSetup

FAMILIES = ("challenge", "large", "flat", "demo")  # those of burger_simulator
PRESETS = ("heat", "reference", "page")  # the files of rover_bringup
PARAMETERS = (
    click.option("--params", type=FILE, metavar="YAML",
                 help="Parameters of heat_node instead of a preset."),
    click.option("--time-limit", type=Real(10.0, 36_000.0), metavar="S",
                 help="The mission's time limit [s], instead of the parameters'."),
)  # fmt: skip
# Of the simulator: first the maze, then variants of the robot by the names that users write.
MAZE = (
    click.option("--family", type=click.Choice(FAMILIES), default="challenge",
                 show_default=True, metavar="NAME",
                 help=f"Of the generated maze: {', '.join(FAMILIES)}."),
    click.option("--world", type=FILE, metavar="YAML", help="A saved maze instead."),
    click.option("--scan-rate", type=click.Choice(["5", "10"]), metavar="N",
                 help="Turns of the lidar [1/s], 5 or 10.  [default: 10]"),
    click.option("--thermal-rate", type=click.Choice(["1", "10"]), metavar="N",
                 help="Frames of each thermal sensor [1/s], 1 or 10.  [default: 10]"),
    click.option("--thermal-delay", type=Real(0.0, 1.0), metavar="S",
                 help="From a thermal frame to its arrival [s].  [default: 0.05]"),
    click.option("--dead-sensor", type=click.Choice(["1", "2"]), metavar="N",
                 help="A thermal sensor that says nothing, 1 or 2."),
    click.option("--offset", type=Real(-10.0, 10.0), metavar="K",
                 help="Added to what both thermal sensors say [K]."),
    click.option("--box", is_flag=True, help="A body of 0.27 x 0.30 m with corners, not a disc."),
)  # fmt: skip


@dataclass(frozen=True)
class HeatOptions:
    """In which maze, with which variant of the robot, by which parameters."""

    family: str
    world: Path | None
    scan_rate: str | None
    thermal_rate: str | None
    thermal_delay: float | None  # [s]
    dead_sensor: str | None
    offset: float | None  # [K]
    box: bool
    params: Path | None = None
    time_limit: float | None = None  # [s]

    def saved_maze(self) -> Maze | None:
        """That of the file, None for a generated one; raises MazeError."""
        from burger_simulator.world.maze import Maze

        return None if self.world is None else Maze.load(self.world)

    def maze(self, seed: int) -> Maze:
        """Raises MazeError."""
        from burger_simulator.world.generator import generate_maze

        return self.saved_maze() or generate_maze(seed, self.family)

    def setup(self, preset: str) -> HeatSetup:
        """Raises PresetError."""
        from rover_tools.evaluation.heat_setup import HeatSetup

        parameters = {} if self.time_limit is None else {"time_limit": self.time_limit}
        return HeatSetup.of(preset, self.params, self._variant(), **parameters)

    def simulator(self) -> dict[str, Any]:
        """Parameters of burger_node."""
        from rover_tools.evaluation.heat_setup import options_of

        maze = {"family": self.family} if self.world is None else {"world": self.world.absolute()}
        return {**maze, **options_of(self._variant())}

    def _variant(self) -> dict[str, Any]:
        """What was asked for, by the names of heat_setup.VARIANTS."""
        given: dict[str, Any] = {
            "scan_rate": self.scan_rate and float(self.scan_rate),
            "thermal_rate": self.thermal_rate and float(self.thermal_rate),
            "thermal_delay": self.thermal_delay,
            "dead_sensor": self.dead_sensor and int(self.dead_sensor),
            "offset": self.offset,
            "box": self.box or None,
        }
        return {name: value for name, value in given.items() if value is not None}


def maze_options(function: F) -> F:
    """Maze and robot, which reach the function as `options`, a HeatOptions."""
    return _with_options(function, MAZE)


def heat_options(function: F) -> F:
    """The same with the mission's parameters."""
    return _with_options(function, (*MAZE[:2], *PARAMETERS, *MAZE[2:]))


def _with_options(function: F, declared: Sequence[Callable[[Any], Any]]) -> F:
    names = [field.name for field in fields(HeatOptions)]

    @functools.wraps(function)
    def with_options(**given: Any) -> Any:
        options = HeatOptions(**{name: given.pop(name) for name in names if name in given})
        return function(options=options, **given)

    decorated: Any = with_options
    for option in reversed(declared):
        decorated = option(decorated)
    return decorated  # type: ignore[no-any-return]


preset_option = click.option(
    "--preset", type=click.Choice(PRESETS), default="heat", show_default=True, metavar="NAME",
    help=f"Parameters that ship: {', '.join(PRESETS)}.",
)  # fmt: skip
presets_option = click.option(
    "--preset", "presets", type=NamesType(PRESETS), default="heat", show_default=True,
    metavar="NAMES", help=f"Parameters that ship, separated by commas: {', '.join(PRESETS)}.",
)  # fmt: skip
