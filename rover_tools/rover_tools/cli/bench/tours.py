"""`rover bench tours`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_simulator.options import map_option, time_limit_option
from rover_tools.cli.options import NamesType, json_option, out_option, seeds_option

DRIVERS = ("steady", "rough")
SEEDS = "63,71"  # no constant of perception was chosen with these


@click.command("tours")
@seeds_option("63,71", "Seeds of the canyons")  # none that a constant of perception was chosen with
@map_option("This map's canyon instead; the seeds draw its samples.")
@click.option("--drivers", type=NamesType(DRIVERS), default=",".join(DRIVERS), show_default=True,
              metavar="NAMES", help="Drivers separated by commas.")  # fmt: skip
@time_limit_option(600.0, "Simulated time for each tour [s].")
@out_option
@json_option
def command(
    seeds: tuple[int, ...],
    map_file: Path | None,
    drivers: tuple[str, ...],
    time_limit: float,
    out: Path | None,
    as_json: bool,
) -> None:
    """Measure the maps of whole missions, driven steadily and roughly.

    Each mission runs in one process without ROS; the map is that of its last frame. The rough
    driver overrides the mission for seconds at a time, full throttle with the steering held, so
    that the rover runs up walls, rocks and comes down, with tilted images.

    \b
    Examples:
      ./rover bench tours
      ./rover bench tours --seeds 63 --drivers rough --time-limit 120
    """
    from rover_simulator.options import WorldOptions
    from rover_tools.benchmarks.tours import bench

    worlds = [WorldOptions(seed, map_file=map_file) for seed in seeds]
    bench(worlds, drivers, time_limit, out, as_json)
