"""`rover mission`."""

from __future__ import annotations

import click

from rover_simulator.options import WorldOptions, world_options
from rover_tools.cli.mission_options import MissionOptions, mission_options
from rover_tools.output import note


@click.command("mission")
@world_options
@mission_options(time_limit=900.0)
def command(world: WorldOptions, options: MissionOptions) -> None:
    """Run one mission in the embedded simulator, from the start to its end, and score it.

    The three nodes run as processes; the simulator waits for their answers, so that a slow machine
    changes nothing. The result folder holds a recording, a report and a video of it.

    \b
    Examples:
      ./rover mission --seed 3
      ./rover mission --seed 3 --strategy frontier --way-home bearing --fps 12.5
      ./rover mission --map docs/examples/map.png --seed 8 --json
    """
    result, folder = options.run("mission", world)
    note(
        f"{result['reason']} after {result['time']} s of simulated time, "
        f"{result['samples_collected']} of {result['samples_total']} samples; results in {folder}"
    )
