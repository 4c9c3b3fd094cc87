"""`rover replay RUN`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from rover_common.command_line import Whole
from rover_tools.cli.options import (
    FILE_OR_FOLDER,
    json_option,
    out_option,
    params_option,
    samples_option,
    truth_option,
)
from rover_tools.output import note, print_result, result_folder

if TYPE_CHECKING:
    from rover_simulator.recordings.recording import YawConvention

YAW_CONVENTIONS = ("ccw-from-east", "cw-from-north")


@click.command("replay")
@click.argument("path", type=FILE_OR_FOLDER, metavar="RUN")
@truth_option
@samples_option
@click.option("--yaw-convention", type=click.Choice(YAW_CONVENTIONS), default=YAW_CONVENTIONS[0],
              show_default=True, help="Convention of the yaw in robot_log.csv.")  # fmt: skip
@click.option("--in-flight", type=Whole(1, 3), default=2, show_default=True, metavar="N",
              help="Telemetries unanswered at a time.")  # fmt: skip
@params_option
@out_option
@json_option
def command(
    path: Path,
    truth: Path | None,
    samples: Path | None,
    yaw_convention: YawConvention,
    in_flight: int,
    params: Path | None,
    out: Path | None,
    as_json: bool,
) -> None:
    """Play a recorded run through the graph again, and score the map.

    RUN is a recording in MCAP: the file, its folder, or the result folder of a mission. It is
    played through perception and decision, and their map is compared with the recorded one, cell
    for cell. Or RUN holds robot_log.csv and its images in IMG, as the Unity simulator records
    them. It is played over the wire through the whole graph.

    \b
    Examples:
      ./rover replay docs/examples/recording
      ./rover replay docs/examples/recording --truth docs/examples/map.png
      ./rover replay results/seed-3
    """
    from rover_recorder.reader import find_recording
    from rover_tools.evaluation.parameters import read_parameters
    from rover_tools.evaluation.recordings import load_log
    from rover_tools.evaluation.results import Truth, summary
    from rover_tools.runner.recorded_run import recorded_run
    from rover_tools.runner.recording import load_recording
    from rover_tools.runner.replay import replay_log
    from rover_tools.runner.replay_recording import replay_recording

    known = Truth.load(truth, samples)
    if params is not None:
        read_parameters(params)  # for its errors: the nodes read it themselves
    if find_recording(path) is not None:
        recording = recorded_run(load_recording(path))
        folder = result_folder("replay", out)
        result = replay_recording(recording, folder, params, known, in_flight)
    else:
        log = load_log(path, yaw_convention)
        folder = result_folder("replay", out)
        result = replay_log(log, folder, params, known, in_flight, str(path))
    print_result(result, as_json, summary(result))
    note(f"replayed {result['frames']} frames; results in {folder}")
