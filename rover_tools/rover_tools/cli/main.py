"""The `rover` command line: its commands by name."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import click

from rover_common.command_line import run_command
from rover_tools.cli.lazy_group import Entry, LazyGroup

NAME = "rover"
COMMANDS = "rover_tools.cli.commands"
TABLE = {
    "demo": Entry(f"{COMMANDS}.demo", "a whole mission in a small generated canyon, scored"),
    "mission": Entry(f"{COMMANDS}.mission", "one mission in the embedded simulator, to its end"),
    "scoreboard": Entry(f"{COMMANDS}.scoreboard", "many missions without ROS, and their table"),
    "drive": Entry(f"{COMMANDS}.drive", "drive by the keys of the terminal, and record it"),
    "record": Entry(f"{COMMANDS}.record", "all topics of the running graph, into an MCAP file"),
    "report": Entry(f"{COMMANDS}.report", "report, video and track of a recorded mission"),
    "replay": Entry(f"{COMMANDS}.replay", "play a recorded run again, and score the map"),
    "view": Entry(f"{COMMANDS}.view", "show a recording on the live page, with a time slider"),
    "map": Entry(f"{COMMANDS}.map", "the world map of the running graph, without ros2"),
    "explain": Entry(f"{COMMANDS}.explain", "perception's stages on one image, as a picture"),
    "sim": Entry("rover_simulator.main", "the embedded simulator alone, for any rover server"),
    "new": Entry(f"{COMMANDS}.new", "a package with an explorer or a perception of your own"),
    "chaos": Entry(f"{COMMANDS}.chaos", "a mission whose nodes and wires have faults by a seed"),
    "heat": Entry(
        "rover_tools.cli.heat.group", "the second robot's mission: demo, mission, scoreboard, sim"
    ),
    "bench": Entry(
        "rover_tools.cli.bench.group", "graph, perception, decision, simulator or tours"
    ),
    "test": Entry(f"{COMMANDS}.test", "all tests, or those that pytest's arguments choose"),
    "run": Entry(f"{COMMANDS}.run", "an executable of a package, as `ros2 run` does"),
    "shell": Entry(f"{COMMANDS}.shell", "a shell in which the workspace is sourced"),
    "build": Entry(f"{COMMANDS}.build", "set up and build, nothing more"),
    "doctor": Entry(f"{COMMANDS}.doctor", "what is missing or wrong on this machine"),
    "completion": Entry(f"{COMMANDS}.completion", "the completion script of bash, zsh or fish"),
}


@click.command(
    cls=LazyGroup,
    table=TABLE,
    name=NAME,
    context_settings={"help_option_names": ["-h", "--help"]},
    options_metavar="",
    subcommand_metavar="COMMAND [OPTIONS]",
)
def rover() -> None:
    """Run, evaluate and measure the rover.

    In a checkout this is ./rover, which first sets up what is missing; PYTHON chooses its
    interpreter, 3.11 or 3.12. With `--platform noble` after a command it runs with Ubuntu 24.04's
    versions of the libraries, installed beside the others.

    \b
    Examples:
      ./rover demo
      ./rover mission --seed 3 --out results/seed-3
      ./rover test --platform noble
      ./rover COMMAND --help
    """


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command that the arguments name; returns the exit code."""
    given = sys.argv[1:] if arguments is None else arguments
    return run_command(rover, NAME, given or ["--help"])


if __name__ == "__main__":
    sys.exit(main())
