"""`rover bench simulator`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_tools.cli.options import json_option


@click.command("simulator")
@click.option("--picture", type=click.Path(dir_okay=False, path_type=Path), metavar="FILE",
              help="Draw recorded frames beside rendered ones.")  # fmt: skip
@json_option
def command(picture: Path | None, as_json: bool) -> None:
    """Measure the embedded simulator: against recordings, and its speed.

    Motion, tilt and images are compared with recordings of the original where there are some;
    speed and memory are measured in any case.

    \b
    Examples:
      ./rover bench simulator
      ./rover bench simulator --picture frames.png --json
    """
    from rover_tools.benchmarks.simulator import bench

    bench(picture, as_json)
