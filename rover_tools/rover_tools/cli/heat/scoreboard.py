"""`rover heat scoreboard`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_tools.cli.heat.options import HeatOptions, heat_options, presets_option
from rover_tools.cli.options import (
    SeedsType,
    json_option,
    out_option,
    scheduler_option,
    workers_option,
)
from rover_tools.output import result_folder


@click.command("scoreboard")
@click.option("--worlds", type=SeedsType(), default="1-4", show_default=True, metavar="SEEDS",
              help="Seeds of the mazes, as 1-40 or 1,5,9.")  # fmt: skip
@presets_option
@heat_options
@workers_option
@scheduler_option
@out_option
@json_option
def command(
    worlds: tuple[int, ...],
    presets: tuple[str, ...],
    options: HeatOptions,
    workers: int | None,
    scheduler: str | None,
    out: Path | None,
    as_json: bool,
) -> None:
    """Run many heat missions, and see what they achieve how often.

    Each mission runs in one process without ROS: the same as ./rover heat mission, tick for tick.
    A table of the figures by which the mission is accepted is printed; the result folder holds it
    beside what is wanted (acceptance.md), a report (report.html), and a picture and a JSON file per
    mission. With the same --out, only the missing missions run, and other presets and variants join
    the tables.

    \b
    Examples:
      ./rover heat scoreboard --worlds 1-10
      ./rover heat scoreboard --worlds 1-10 --preset heat,reference --out results/race
      ./rover heat scoreboard --worlds 1-10 --thermal-rate 1 --json
    """
    from rover_tools.scoreboard.heat_board import HEAT_BOARD
    from rover_tools.scoreboard.heat_job import make_heat_jobs
    from rover_tools.scoreboard.run import Engine, run_scoreboard

    setups = {setup.label: setup for setup in map(options.setup, presets)}
    jobs = make_heat_jobs(worlds, options.family, options.saved_maze(), list(setups.values()))
    folder = result_folder("heat-scoreboard", out)
    run_scoreboard(jobs, HEAT_BOARD, folder, Engine(scheduler, workers), as_json)
