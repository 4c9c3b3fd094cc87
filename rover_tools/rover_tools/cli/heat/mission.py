"""`rover heat mission`."""

from __future__ import annotations

import click

from rover_simulator.options import seed_option
from rover_tools.cli.heat.graph_options import GraphOptions, graph_options
from rover_tools.cli.heat.options import HeatOptions, heat_options, preset_option
from rover_tools.output import note


@click.command("mission")
@seed_option("Seed of the generated maze, and of the sensors' noise.")
@preset_option
@heat_options
@click.option("--loop", "in_process", is_flag=True,
              help="Run in one process without ROS: the same mission, with report and video, and "
              "without recording and page.")  # fmt: skip
@graph_options
def command(
    seed: int, preset: str, options: HeatOptions, in_process: bool, graph: GraphOptions
) -> None:
    """Run one heat mission in a maze, from the start to its end, and score it.

    The robot explores the maze, finds what is warm, delivers a payload to each source and climbs
    the ramp. Robot, navigator and mission run as processes; the simulator waits for their answers,
    so that a slow machine changes nothing. The result folder holds a recording, a report, a video.

    \b
    Examples:
      ./rover heat mission --seed 7
      ./rover heat mission --seed 7 --preset reference --json
      ./rover heat mission --family large --seed 2 --thermal-rate 1 --loop
    """
    setup = options.setup(preset)
    maze = options.maze(seed)
    result, folder = graph.run("heat-mission", maze, seed, setup, in_process)
    mark = "success" if result["success"] else "no success"
    note(
        f"{mark}: {result['reason']} after {result['time']} s of simulated time, "
        f"{result['sources_found']} of {result['sources_total']} sources found, "
        f"{result['delivered']} delivered; results in {folder}"
    )
