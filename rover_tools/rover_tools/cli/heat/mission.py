"""`rover heat mission`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_simulator.options import seed_option
from rover_tools.cli.heat.options import HeatOptions, heat_options, preset_option
from rover_tools.cli.options import json_option, out_option
from rover_tools.output import note, print_result, result_folder


@click.command("mission")
@seed_option("Seed of the generated maze, and of the sensors' noise.")
@preset_option
@heat_options
@out_option
@json_option
def command(seed: int, preset: str, options: HeatOptions, out: Path | None, as_json: bool) -> None:
    """Run one heat mission in a maze, from the start to its end, and score it.

    The robot explores the maze, finds what is warm, delivers a payload to each source and climbs
    the ramp. The result folder holds the result and the maze.

    \b
    Examples:
      ./rover heat mission --seed 7
      ./rover heat mission --seed 7 --preset reference --json
      ./rover heat mission --family large --seed 2 --thermal-rate 1
    """
    from rover_tools.evaluation.results import summary
    from rover_tools.scoreboard.heat_job import HeatJob
    from rover_tools.scoreboard.heat_run import complete

    job = HeatJob(options.setup(preset), seed, options.family, options.maze())
    folder = result_folder("heat-mission", out)
    result = complete(job, folder)
    print_result(result, as_json, summary(result))
    note(f"results in {folder}")
