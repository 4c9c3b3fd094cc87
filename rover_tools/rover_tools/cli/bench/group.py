"""`rover bench NAME`: the benchmarks by name."""

from __future__ import annotations

import click

from rover_tools.cli.lazy_group import Entry, LazyGroup

BENCH = "rover_tools.cli.bench"
TABLE = {
    "graph": Entry(f"{BENCH}.graph", "telemetry to command through the three nodes"),
    "perception": Entry(f"{BENCH}.perception", "time per frame and map scores"),
    "decision": Entry(f"{BENCH}.decision", "time per frame and per plan"),
    "simulator": Entry(f"{BENCH}.simulator", "the embedded simulator against recordings"),
    "tours": Entry(f"{BENCH}.tours", "maps of whole missions, driven steadily and roughly"),
}


@click.command(
    cls=LazyGroup,
    table=TABLE,
    name="bench",
    options_metavar="",
    subcommand_metavar="NAME [OPTIONS]",
)
def command() -> None:
    """Measure a part of the system.

    Recorded runs are used where ROVER_DATA points to them; a benchmark that has none says so.

    \b
    Examples:
      ./rover bench graph
      ./rover bench decision --seeds 5 --json
    """
