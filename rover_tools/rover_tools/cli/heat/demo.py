"""`rover heat demo`."""

from __future__ import annotations

import click

from rover_simulator.options import seed_option
from rover_tools.cli.heat.graph_options import GraphOptions, graph_options
from rover_tools.output import note


@click.command("demo")
@seed_option("Seed of the maze.")
@graph_options
def command(seed: int, graph: GraphOptions) -> None:
    """Run a whole heat mission in a small maze: explore, deliver at once, climb the ramp.

    Its live page is served meanwhile, at the address that is printed.

    \b
    Examples:
      ./rover heat demo
      ./rover heat demo --seed 3 --open
    """
    from burger_simulator.world.generator import generate_maze
    from rover_tools.evaluation.heat_setup import HeatSetup

    setup = HeatSetup.of(deliver="at_once")
    result, folder = graph.run("heat-demo", generate_maze(seed, "demo"), seed, setup, False)
    ramp = "stands on the ramp" if result["ramp_done"] else "is not on the ramp"
    note(
        f"the robot {ramp} after {result['time']} s of simulated time, with "
        f"{result['delivered']} of {result['sources_total']} heat sources served; "
        f"look at {folder / ('result.json' if graph.no_record else 'report.html')}"
    )
