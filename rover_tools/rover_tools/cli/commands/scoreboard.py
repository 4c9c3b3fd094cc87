"""`rover scoreboard`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_simulator.options import fps_option, map_option, size_option, time_limit_option
from rover_tools.cli.options import (
    SYNTAX,
    SeedsType,
    StrategiesType,
    json_option,
    out_option,
    scheduler_option,
    seeds_option,
    way_home_option,
    workers_option,
)
from rover_tools.output import result_folder

DEFAULT_WORLDS = (1, 2, 3, 4)


@click.command("scoreboard")
@click.option("--worlds", type=SeedsType(), metavar="SEEDS",
              help="Generated canyons, as 101-140 or 1,5,9.  [default: 1-4, or none with --map]"
              )  # fmt: skip
@map_option("A map of 200 x 200 pixels too; white is ground.")
@seeds_option("1-4", "Seeds that draw the samples on the map")
@click.option("--strategies", type=StrategiesType(), default="tour", show_default=True,
              metavar="NAMES", help=f"Strategies separated by commas, each {SYNTAX}.")  # fmt: skip
@way_home_option
@size_option()
@fps_option()
@time_limit_option(900.0, "Give a mission up after this simulated time [s].")
@workers_option
@scheduler_option
@out_option
@json_option
def command(
    worlds: tuple[int, ...] | None,
    map_file: Path | None,
    seeds: tuple[int, ...],
    strategies: tuple[str, ...],
    way_home: str | None,
    size: float,
    fps: float,
    time_limit: float,
    workers: int | None,
    scheduler: str | None,
    out: Path | None,
    as_json: bool,
) -> None:
    """Run many missions, and see which strategy achieves what how often.

    Every strategy runs in every world, each mission in one process without ROS: the same mission as
    that of ./rover mission, frame for frame. A table is printed; the result folder holds a report
    (report.html), and a picture and a JSON file per mission. Run it again with the same --out, and
    only the missing missions run.

    \b
    Examples:
      ./rover scoreboard
      ./rover scoreboard --worlds 1-20 --strategies tour,frontier
      ./rover scoreboard --map docs/examples/map.png --seeds 1-20
      ./rover scoreboard --worlds 1-20 --out results/s1
    """
    from rover_tools.evaluation.strategy import Strategy
    from rover_tools.scoreboard.job import Ground, make_jobs
    from rover_tools.scoreboard.rover_board import BOARD
    from rover_tools.scoreboard.run import Engine, run_scoreboard

    if worlds is None:
        worlds = () if map_file else DEFAULT_WORLDS
    named = (str(Strategy.parse(name).coming_home(way_home)) for name in strategies)
    strategies = tuple(dict.fromkeys(named))
    ground = None if map_file is None else Ground.load(map_file)
    jobs = make_jobs(worlds, ground, seeds, strategies, size=size, fps=fps, time_limit=time_limit)
    folder = result_folder("scoreboard", out)
    run_scoreboard(jobs, BOARD, folder, Engine(scheduler, workers), as_json)
