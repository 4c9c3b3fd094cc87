"""`rover demo`."""

from __future__ import annotations

import click

from rover_simulator.options import WorldOptions, seed_option, size_option
from rover_tools.cli.mission_options import MissionOptions, mission_options
from rover_tools.output import note


@click.command("demo")
@seed_option("Seed of the canyon.")
@size_option(0.4)
@mission_options(time_limit=600.0)
def command(seed: int, size: float, options: MissionOptions) -> None:
    """Run a whole mission in a small generated canyon: explore, collect, return home.

    The three nodes run as they always do; the embedded simulator takes the place of the Unity
    simulator. Its live page is served meanwhile, at the address that is printed.

    \b
    Examples:
      ./rover demo
      ./rover demo --seed 7 --out results/demo
    """
    result, folder = options.run("demo", WorldOptions(seed, size))
    state = "is home" if result["done"] else "is not home"
    note(
        f"the rover {state} after {result['time']} s of simulated time, with "
        f"{result['samples_collected']} of {result['samples_total']} samples; it mapped "
        f"{result['percent_mapped']} % of the canyon at {result['fidelity']} % fidelity; "
        f"look at {folder / ('map.png' if options.no_record else 'report.html')}"
    )
