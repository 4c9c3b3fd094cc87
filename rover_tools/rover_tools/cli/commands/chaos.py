"""`rover chaos`."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click

from rover_common.command_line import Real
from rover_simulator.options import WorldOptions, fps_option, world_options
from rover_tools.cli.options import json_option, out_option, params_option
from rover_tools.output import note, print_result, result_folder

SIZE = 0.3  # of a canyon in which a mission takes a few minutes
HARMED = 1  # exit code


@click.command("chaos")
@partial(world_options, size=SIZE)
@click.option("--minutes", type=Real(0.0, 600.0), default=5.0, show_default=True, metavar="N",
              help="Wall time in which faults come; 0 for a mission without.")  # fmt: skip
@click.option("--rate", type=Real(0.0, 20.0, min_open=True), default=1.0, show_default=True,
              metavar="N", help="Times real time, if the machine is fast enough.")  # fmt: skip
@fps_option()
@params_option
@out_option
@json_option
def command(
    world: WorldOptions,
    minutes: float,
    rate: float,
    fps: float,
    params: Path | None,
    out: Path | None,
    as_json: bool,
) -> int:
    """Run one mission while its nodes are killed and stopped, and its wires are harmed.

    The seed decides which faults come, and when: nodes that are killed or stopped, floods, idle
    connections, bytes that are no messages, and messages that no node sends. Each is a line on
    standard error. The exit code is 0 if the rover is home with all samples and nothing was lost:
    no sample, no part of the map, no rock, not home, and not the mission.

    \b
    Examples:
      ./rover chaos
      ./rover chaos --seed 3 --minutes 5 --json
      ./rover chaos --size 1 --minutes 15 --out results/chaos
    """
    from rover_tools.chaos.outcome import unharmed
    from rover_tools.chaos.run import Chaos, run_chaos
    from rover_tools.evaluation.parameters import read_parameters
    from rover_tools.evaluation.results import summary

    if params is not None:
        read_parameters(params)  # for its errors: the nodes read it themselves
    loaded, folder = world.load(), result_folder("chaos", out)
    result = run_chaos(loaded, Chaos(world.seed, minutes, rate, fps, params), folder)
    print_result(result, as_json, summary(result))
    state = "is home" if result["done"] else "is not home"
    note(
        f"the rover {state} after {result['faults']} faults, with {result['samples_collected']} of "
        f"{result['samples_total']} samples; lost: {'; '.join(result['lost']) or 'nothing'}; it "
        f"went on for at most {result['worst_brake_ms']} ms without a command before it braked; "
        f"results in {folder}"
    )
    return 0 if unharmed(result) else HARMED
