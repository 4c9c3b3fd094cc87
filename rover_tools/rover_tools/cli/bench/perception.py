"""`rover bench perception`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_tools.cli.options import json_option, out_option, seeds_option


@click.command("perception")
@click.option("--generated", is_flag=True, help="Use generated canyons in any case.")
@seeds_option("1-3", "Seeds of the generated canyons")
@out_option
@json_option
def command(generated: bool, seeds: tuple[int, ...], out: Path | None, as_json: bool) -> None:
    """Measure perception: time per frame and map scores, beside a baseline.

    Runs the core without ROS, in one thread, on recorded runs where there are some, else on drives
    rendered through generated canyons. Reading the images is not counted.

    \b
    Examples:
      ./rover bench perception
      ./rover bench perception --generated --seeds 1,2
    """
    from rover_tools.benchmarks.perception import bench

    bench(generated, seeds, out, as_json)
