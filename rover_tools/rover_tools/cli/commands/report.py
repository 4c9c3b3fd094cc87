"""`rover report RUN`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_tools.cli.options import (
    FILE_OR_FOLDER,
    json_option,
    out_option,
    samples_option,
    truth_option,
)
from rover_tools.output import note, print_result, result_folder


@click.command("report")
@click.argument("path", type=FILE_OR_FOLDER, metavar="RUN")
@truth_option
@samples_option
@out_option
@json_option
def command(
    path: Path, truth: Path | None, samples: Path | None, out: Path | None, as_json: bool
) -> None:
    """Make the report, the video and the track of a recorded mission.

    RUN is a result folder, the folder of a recording, or its .mcap file, also of a run with the
    Unity simulator; of several missions in it, the last one counts. It may be of either robot; a
    heat mission's result folder has the truth of its maze. Open report.html in a browser.

    \b
    Examples:
      ./rover report recordings/first
      ./rover report recordings/first --truth map_bw.png --samples docs/examples/samples.csv
    """
    from rover_recorder.reader import open_recording
    from rover_tools.evaluation.results import Truth, summary
    from rover_tools.output import write_result
    from rover_tools.report.heat_files import write_heat_report
    from rover_tools.report.heat_truth import HeatTruth
    from rover_tools.report.recorded_heat import holds_heat_mission
    from rover_tools.report.recording_report import REPORT, write_report

    known = Truth.load(truth, samples)
    folder, title = result_folder("report", out), path.resolve().name
    if holds_heat_mission(open_recording(path)):
        result = write_heat_report(folder, path, title, HeatTruth.load(path))
    else:
        result = write_report(folder, path, known, title)
    write_result(folder, result)
    print_result(result, as_json, summary(result))
    note(f"look at {folder / REPORT}")
