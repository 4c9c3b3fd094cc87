"""`rover heat sim`."""

from __future__ import annotations

import os

import click

from rover_common.command_line import Real
from rover_simulator.options import seed_option
from rover_tools.cli.heat.options import HeatOptions, maze_options


@click.command("sim")
@seed_option("Seed of the generated maze, and of the sensors' noise.")
@maze_options
@click.option("--rate", type=Real(0.0, 1000.0), default=1.0, show_default=True, metavar="X",
              help="Times real time; 0 as fast as it goes.")  # fmt: skip
def command(seed: int, options: HeatOptions, rate: float) -> None:
    """Run the second robot's simulator alone, as its drivers: burger_node.

    It publishes scan, odometry, temperatures and /clock, and takes velocities and launches, in the
    domain of ROS_DOMAIN_ID, until Ctrl-C: for a navigator and a mission of your own.

    \b
    Examples:
      ./rover heat sim --seed 7
      ./rover heat sim --family demo --rate 2
    """
    from rover_tools.cli.commands.run import find_executable

    path = str(find_executable("burger_simulator", "burger_node"))
    values = options.simulator() | {"seed": seed, "rate": rate}
    arguments = [f"{name}:={value}" for name, value in values.items()]
    os.execv(path, [path, "--ros-args", *(word for each in arguments for word in ("-p", each))])
