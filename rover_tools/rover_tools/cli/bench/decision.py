"""`rover bench decision`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rover_simulator.options import fps_option, map_option, size_option, time_limit_option
from rover_tools.cli.options import (
    json_option,
    out_option,
    seeds_option,
    strategy_option,
    way_home_option,
)

if TYPE_CHECKING:
    from rover_tools.evaluation.strategy import Strategy

FPS = 12.5  # [1/s] half of the usual rate, in half of the time: a frame costs the same


@click.command("decision")
@seeds_option("5", "Seeds of the canyons, one mission each")
@map_option("This map's canyon instead; the seeds draw its samples.")
@size_option()
@strategy_option("tour")
@way_home_option
@fps_option(FPS)
@time_limit_option(900.0, "Simulated time for each mission [s].")
@click.option(
    "--long",
    "drive_on",
    is_flag=True,
    help="Search for a sample that is not there until the time is over.",
)
@out_option
@json_option
def command(
    seeds: tuple[int, ...],
    map_file: Path | None,
    size: float,
    strategy: Strategy | None,
    way_home: str | None,
    fps: float,
    time_limit: float,
    drive_on: bool,
    out: Path | None,
    as_json: bool,
) -> None:
    """Measure what decision costs per frame, and each plan.

    Whole missions in one process without ROS. Plans are made in their thread as always, but the
    loop waits for each before it continues, so that no plan is timed while the simulator and
    perception take the interpreter from it. `wall` is the time that a frame or a plan took,
    `thread` the processor time of its thread: on a busy machine the former counts other programs as
    well. With `--long` each mission lasts for the whole time limit: it shows whether the costs grow
    with the map.

    \b
    Examples:
      ./rover bench decision
      ./rover bench decision --seeds 1-3 --size 0.4 --strategy frontier
      ./rover bench decision --long --seeds 39 --size 2 --time-limit 1200
    """
    from rover_simulator.options import WorldOptions
    from rover_tools.benchmarks.decision import bench
    from rover_tools.evaluation.strategy import Strategy

    worlds = [WorldOptions(seed, size, map_file) for seed in seeds]
    chosen = (strategy or Strategy()).coming_home(way_home)
    bench(worlds, chosen, fps, time_limit, out, as_json, drive_on)
