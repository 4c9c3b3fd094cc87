"""`rover bench NAME`: the benchmarks by name."""

from __future__ import annotations

import importlib
import sys

BENCHMARKS = {
    "graph": ("rover_tools.benchmarks.graph", "telemetry to command through the three nodes"),
    "simulator": ("rover_tools.benchmarks.simulator", "the embedded simulator against recordings"),
    "perception": ("rover_tools.benchmarks.perception", "time per frame and map scores"),
    "decision": ("rover_tools.benchmarks.decision", "time per frame and per plan"),
    "tours": (
        "rover_tools.benchmarks.tours",
        "maps of whole missions, driven steadily and roughly",
    ),
}


def main(arguments: list[str]) -> int:
    """Run the benchmark named first."""
    if not arguments or arguments[0] not in BENCHMARKS:
        help_asked = bool(arguments) and arguments[0] in ("-h", "--help")
        lines = [f"  {name:12} {text}" for name, (_, text) in BENCHMARKS.items()]
        usage = "usage: rover bench NAME [--json]\n\n" + "\n".join(lines)
        print(usage, file=sys.stdout if help_asked else sys.stderr)
        return 0 if help_asked else 2
    return importlib.import_module(BENCHMARKS[arguments[0]][0]).main(arguments[1:])
