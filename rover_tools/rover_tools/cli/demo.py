"""`rover demo`: a whole mission in a small generated canyon: explore, collect, come home.

The three nodes run as they always do; the embedded simulator takes the place of the Unity one.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from rover_simulator.world.generator import generate_world
from rover_tools.cli.errors import run_command
from rover_tools.cli.mission import fly
from rover_tools.evaluation.results import summary
from rover_tools.runner.run import note, result_folder

TIME_LIMIT = 600.0  # [s] simulated


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    options = _parser().parse_args(arguments)
    return run_command("demo", lambda: _demo(options))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="rover demo", description=__doc__)
    add = parser.add_argument
    add("--seed", type=int, default=1, help="of the canyon (default: %(default)s)")
    add("--size", type=float, default=0.4,
        help="of the canyon, 1 as large as the original (default: %(default)s)")  # fmt: skip
    add("--out", type=Path, metavar="DIR", help="result folder (default: a new one in ./results)")
    add("--json", action="store_true", help="print the result as one JSON object")
    return parser


def _demo(options: argparse.Namespace) -> None:
    folder = result_folder("demo", options.out)
    world = generate_world(options.seed, options.size)
    result = fly(world, options.seed, TIME_LIMIT, folder)
    print(json.dumps(result) if options.json else summary(result))
    came = "is home" if result["done"] else "is not home"
    note(
        f"the rover {came} after {result['time']} s of simulated time, with "
        f"{result['samples_collected']} of {result['samples_total']} samples; it mapped "
        f"{result['percent_mapped']} % of the canyon at {result['fidelity']} % fidelity; "
        f"look at {folder / 'map.png'}"
    )
