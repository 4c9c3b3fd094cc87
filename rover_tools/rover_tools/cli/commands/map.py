"""`rover map`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_common.command_line import Real
from rover_tools.cli.options import json_option, picture_option


@click.command("map")
@click.option("--wait", type=Real(0.0, 3600.0, min_open=True), default=10.0, show_default=True,
              metavar="S", help="Give up after this time without a map [s].")  # fmt: skip
@picture_option("Draw the map into this file.")
@json_option
def command(wait: float, out: Path | None, as_json: bool) -> None:
    """Show the world map of the running graph: its size, and how many cells are what.

    ROS_DOMAIN_ID names the graph's domain, which a mission prints at its start. The ros2 command
    is not needed.

    \b
    Examples:
      ./rover map
      ROS_DOMAIN_ID=104 ./rover map --out map.png
      ./rover map --json
    """
    from rover_tools.evaluation.results import summary
    from rover_tools.output import note, print_result
    from rover_tools.runner.read_map import read_map

    found = read_map(wait)
    result = found.result()
    print_result(result, as_json, summary(result))
    if out is not None:
        found.draw(out)
        note(f"look at {out}")
