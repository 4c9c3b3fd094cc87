"""`rover mission`."""

from __future__ import annotations

from pathlib import Path

import click
from click.core import ParameterSource

from rover_simulator.options import WorldOptions, world_options
from rover_tools.cli.mission_options import MissionOptions, mission_options
from rover_tools.output import note

# What an interrupted mission keeps.
FIXED = {
    "seed", "size", "map_file", "folder", "strategy", "way_home", "fps", "time_limit", "params",
    "out",
}  # fmt: skip


@click.command("mission")
@world_options
@click.option("--resume", "interrupted", metavar="DIR",
              type=click.Path(file_okay=False, path_type=Path),
              help="Go on with the mission that was interrupted in this folder.")  # fmt: skip
@mission_options(time_limit=900.0)
def command(world: WorldOptions, interrupted: Path | None, options: MissionOptions) -> None:
    """Run one mission in the embedded simulator, from the start to its end, and score it.

    The three nodes run as processes; the simulator waits for their answers, so that a slow machine
    changes nothing. The result folder holds a recording, a report and a video of it.

    With --resume, world, strategy, frame rate, time limit and parameters are those that the mission
    was started with; rover, samples, map and mission go on as they were in the last second.

    \b
    Examples:
      ./rover mission --seed 3
      ./rover mission --seed 3 --strategy frontier --way-home bearing --fps 12.5
      ./rover mission --map docs/examples/map.png --seed 8 --json
      ./rover mission --resume results/mission-20250801-101500-4711
    """
    if interrupted is None:
        result, folder = options.run("mission", world)
    else:
        _refuse_others()
        result, folder = options.resume(interrupted), interrupted
    note(
        f"{result['reason']} after {result['time']} s of simulated time, "
        f"{result['samples_collected']} of {result['samples_total']} samples; results in {folder}"
    )


def _refuse_others() -> None:
    """What a mission was started with cannot be changed when it goes on; raises UsageError."""
    context = click.get_current_context()
    for option in context.command.params:
        given = context.get_parameter_source(option.name or "") is ParameterSource.COMMANDLINE
        if given and option.name in FIXED:
            raise click.UsageError(f"{option.opts[0]} cannot be changed by --resume.")
