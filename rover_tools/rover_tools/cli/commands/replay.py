"""`rover replay DIR`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rover_common.command_line import Whole
from rover_simulator.options import FILE, FOLDER
from rover_tools.cli.options import json_option, out_option, params_option
from rover_tools.output import note, print_result, result_folder

if TYPE_CHECKING:
    from rover_simulator.recordings.recording import YawConvention

YAW_CONVENTIONS = ("ccw-from-east", "cw-from-north")


@click.command("replay")
@click.argument("recording", type=FOLDER, metavar="DIR")
@click.option("--truth", type=FILE, metavar="PNG",
              help="The true map, 200 x 200; non-zero is navigable.")  # fmt: skip
@click.option("--samples", type=FILE, metavar="CSV",
              help="True positions of the rocks in view: x,y [m].")  # fmt: skip
@click.option("--yaw-convention", type=click.Choice(YAW_CONVENTIONS), default=YAW_CONVENTIONS[0],
              show_default=True, help="Convention of the log's yaw.")  # fmt: skip
@click.option("--in-flight", type=Whole(1, 3), default=2, show_default=True, metavar="N",
              help="Telemetries unanswered at a time.")  # fmt: skip
@params_option
@out_option
@json_option
def command(
    recording: Path,
    truth: Path | None,
    samples: Path | None,
    yaw_convention: YawConvention,
    in_flight: int,
    params: Path | None,
    out: Path | None,
    as_json: bool,
) -> None:
    """Play a recorded run over the wire through the graph, and score the map.

    DIR holds robot_log.csv and its images in IMG, as the Unity simulator records them.

    \b
    Examples:
      ./rover replay test_dataset
      ./rover replay test_dataset --truth map_bw.png --samples samples.csv
    """
    from rover_simulator.recordings.recording import read_recording
    from rover_tools.evaluation.results import Truth, summary
    from rover_tools.runner.replay import OVERRIDES, replay
    from rover_tools.runner.run import running_graph

    recorded = read_recording(recording, yaw_convention)
    known = Truth.load(truth, samples)
    folder = result_folder("replay", out)
    with running_graph(folder, OVERRIDES, params) as run:
        result = replay(recorded, run, known, in_flight, str(recording))
    print_result(result, as_json, summary(result))
    note(f"replayed {result['frames']} frames; results in {folder}")
