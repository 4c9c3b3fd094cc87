"""`rover mission`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rover_simulator.options import WorldOptions, fps_option, time_limit_option, world_options
from rover_tools.cli.options import (
    json_option,
    no_dashboard_option,
    no_record_option,
    open_option,
    out_option,
    params_option,
    strategy_option,
)
from rover_tools.output import note, print_result, result_folder

if TYPE_CHECKING:
    from rover_tools.evaluation.strategy import Strategy


@click.command("mission")
@world_options
@strategy_option("that of the parameters")
@fps_option()
@time_limit_option(900.0, "Give up after this simulated time [s].")
@params_option
@no_record_option
@no_dashboard_option
@open_option
@out_option
@json_option
def command(
    world: WorldOptions,
    strategy: Strategy | None,
    fps: float,
    time_limit: float,
    params: Path | None,
    no_record: bool,
    no_dashboard: bool,
    open_page: bool,
    out: Path | None,
    as_json: bool,
) -> None:
    """Run one mission in the embedded simulator, from the start to its end, and score it.

    The three nodes run as processes; the simulator waits for their answers, so that a slow machine
    changes nothing. The result folder holds a recording, a report and a video of it.

    \b
    Examples:
      ./rover mission --seed 3
      ./rover mission --seed 3 --strategy frontier+bearing --fps 12.5
      ./rover mission --map docs/examples/map.png --seed 8 --json
    """
    from rover_tools.evaluation.results import summary
    from rover_tools.runner.mission import run_mission

    loaded = world.load()
    folder = result_folder("mission", out)
    result = run_mission(
        loaded, world.seed, time_limit, folder, parameters=params, strategy=strategy, fps=fps,
        page=not no_dashboard, open_page=open_page, record=not no_record,
    )  # fmt: skip
    print_result(result, as_json, summary(result))
    note(
        f"{result['reason']} after {result['time']} s of simulated time, "
        f"{result['samples_collected']} of {result['samples_total']} samples; results in {folder}"
    )
