"""`rover heat NAME`: the commands of the heat mission by name."""

from __future__ import annotations

import click

from rover_tools.cli.lazy_group import Entry, LazyGroup

HEAT = "rover_tools.cli.heat"
TABLE = {
    "demo": Entry(f"{HEAT}.demo", "a whole heat mission in a small maze, scored"),
    "mission": Entry(f"{HEAT}.mission", "one heat mission in a maze, to its end"),
    "scoreboard": Entry(f"{HEAT}.scoreboard", "many heat missions, and their table"),
    "sim": Entry(f"{HEAT}.sim", "the second robot's simulator alone, as a node"),
}


@click.command(
    cls=LazyGroup,
    table=TABLE,
    name="heat",
    options_metavar="",
    subcommand_metavar="NAME [OPTIONS]",
)
def command() -> None:
    """Run the second mission: find what is warm in a maze, deliver to each, climb the ramp.

    A TurtleBot3 Burger with a lidar and two thermal sensors explores a maze of its own simulator.

    \b
    Examples:
      ./rover heat demo
      ./rover heat mission --seed 7
      ./rover heat scoreboard --worlds 1-10
    """
