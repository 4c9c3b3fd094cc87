"""`rover bench graph`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_common.command_line import Whole
from rover_simulator.options import FOLDER
from rover_tools.cli.options import json_option, out_option


@click.command("graph")
@click.option("--frames", type=Whole(1, 100_000), default=1000, show_default=True, metavar="N",
              help="Frames that count.")  # fmt: skip
@click.option("--recording", type=FOLDER, metavar="DIR",
              help="Frames to use.  [default: a recorded run where there is one, else frames of "
              "the embedded simulator]")  # fmt: skip
@click.option("--insets", is_flag=True,
              help="Compare a client that shows insets with one that does not.")  # fmt: skip
@out_option
@json_option
def command(
    frames: int, recording: Path | None, insets: bool, out: Path | None, as_json: bool
) -> None:
    """Measure telemetry to command through the three nodes.

    The nodes run as processes, connected by the wire and DDS; one telemetry at a time.

    \b
    Examples:
      ./rover bench graph
      ./rover bench graph --frames 200 --json
      ./rover bench graph --insets
    """
    from rover_tools.benchmarks.graph import bench

    bench(frames, recording, insets, out, as_json)
