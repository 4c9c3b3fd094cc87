"""`rover drive`."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import click

from rover_simulator.options import WorldOptions, fps_option, world_options
from rover_tools.cli.options import (
    json_option,
    no_dashboard_option,
    no_record_option,
    open_option,
    out_option,
    params_option,
)
from rover_tools.output import note, print_result, result_folder


@click.command("drive")
@click.option("--attach", is_flag=True,
              help="Drive the graph that runs in the domain of ROS_DOMAIN_ID, and start none."
              )  # fmt: skip
@world_options
@fps_option()
@params_option
@no_record_option
@no_dashboard_option
@open_option
@out_option
@json_option
def command(
    attach: bool,
    world: WorldOptions,
    fps: float,
    params: Path | None,
    no_record: bool,
    no_dashboard: bool,
    open_page: bool,
    out: Path | None,
    as_json: bool,
) -> None:
    """Drive the rover by hand, with the keys of this terminal.

    w and s or the arrows change the speed by half a metre a second, a and d the curve; space
    brakes, q ends. Bridge, perception and the embedded simulator run, in real time; the drive is
    recorded, and its map scored. With --attach a graph that runs is driven, for instance one with
    the Unity simulator: a person comes before its mission.

    \b
    Examples:
      ./rover drive --seed 3
      ROS_DOMAIN_ID=104 ./rover drive --attach
    """
    from rover_tools.evaluation.results import summary
    from rover_tools.runner.drive import drive_graph, drive_world
    from rover_tools.teleop.terminal import Terminal

    terminal = Terminal(sys.stdin.fileno())
    if attach:
        drive_graph(int(os.environ.get("ROS_DOMAIN_ID") or 0), terminal)
        return
    folder = result_folder("drive", out)
    result = drive_world(
        world.load(), world.seed, folder, terminal, fps=fps, parameters=params,
        page=not no_dashboard, open_page=open_page, record=not no_record,
    )  # fmt: skip
    print_result(result, as_json, summary(result))
    note(f"results in {folder}")
