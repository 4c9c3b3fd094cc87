"""`rover demo`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_simulator.options import WorldOptions, seed_option, size_option
from rover_tools.cli.options import (
    json_option,
    no_dashboard_option,
    no_record_option,
    open_option,
    out_option,
)
from rover_tools.output import note, print_result, result_folder

TIME_LIMIT = 600.0  # [s] simulated


@click.command("demo")
@seed_option("Seed of the canyon.")
@size_option(0.4)
@no_record_option
@no_dashboard_option
@open_option
@out_option
@json_option
def command(
    seed: int,
    size: float,
    no_record: bool,
    no_dashboard: bool,
    open_page: bool,
    out: Path | None,
    as_json: bool,
) -> None:
    """Run a whole mission in a small generated canyon: explore, collect, return home.

    The three nodes run as they always do; the embedded simulator takes the place of the Unity
    simulator. Its live page is served meanwhile, at the address that is
    printed. It ends after 600 s of simulated time at the latest.

    \b
    Examples:
      ./rover demo
      ./rover demo --seed 7 --out results/demo
    """
    from rover_tools.evaluation.results import summary
    from rover_tools.runner.mission import run_mission

    folder = result_folder("demo", out)
    result = run_mission(
        WorldOptions(seed, size).load(), seed, TIME_LIMIT, folder,
        page=not no_dashboard, open_page=open_page, record=not no_record,
    )  # fmt: skip
    print_result(result, as_json, summary(result))
    state = "is home" if result["done"] else "is not home"
    note(
        f"the rover {state} after {result['time']} s of simulated time, with "
        f"{result['samples_collected']} of {result['samples_total']} samples; it mapped "
        f"{result['percent_mapped']} % of the canyon at {result['fidelity']} % fidelity; "
        f"look at {folder / ('map.png' if no_record else 'report.html')}"
    )
