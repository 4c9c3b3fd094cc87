"""`rover explain IMAGE`."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from rover_common.command_line import Real, Whole
from rover_simulator.options import LONGEST
from rover_tools.cli.options import FILE_OR_FOLDER, picture_option
from rover_tools.output import note

F = TypeVar("F", bound=Callable[..., Any])

MOST_TILT = 60.0  # [degrees] beyond, the rover lies on its side


def _tilt_option(name: str, positive: str) -> Callable[[F], F]:
    return click.option(
        f"--{name}", type=Real(-MOST_TILT, MOST_TILT), metavar="DEG",
        help=f"Of an image: its {name} [degrees], {positive}.  [default: 0]",
    )  # fmt: skip


@click.command("explain")
@click.argument("path", type=FILE_OR_FOLDER, metavar="IMAGE")
@click.option("--frame", "number", type=Whole(min=0), metavar="N",
              help="Of a run: its frame, from 0.  [default: the last one]")  # fmt: skip
@click.option("--time", type=Real(0.0, LONGEST), metavar="S",
              help="Of a run: the newest frame then, seconds after the first.")  # fmt: skip
@_tilt_option("pitch", "positive with the nose down")
@_tilt_option("roll", "positive with the right side down")
@picture_option("The picture's file.  [default: explain.png in a new folder in ./results]")
def command(
    path: Path,
    number: int | None,
    time: float | None,
    pitch: float | None,
    roll: float | None,
    out: Path | None,
) -> None:
    """Show what each stage of perception makes of an image, beside the baseline.

    IMAGE is a picture of the rover's camera, 320 x 160. Or it is a run, of which one frame is
    shown: a folder with robot_log.csv, a recording in MCAP, or the result folder of a mission. The
    maps then hold the frames before it too, at most 500.

    \b
    Examples:
      ./rover explain docs/examples/recording --frame 132 --out explain.png
      ./rover explain docs/examples/recording/IMG/frame_00132.jpg --pitch 0.5
      ./rover explain results/seed-3 --time 60
    """
    if number is not None and time is not None:
        raise click.UsageError("--frame and --time exclude each other.")
    from rover_tools.explain.frames import FrameChoice, is_run, load_image, load_run

    if is_run(path):
        if pitch is not None or roll is not None:
            raise click.UsageError("--pitch and --roll are for one image; a run has its own.")
        source = load_run(path, FrameChoice(number, time))
    else:
        if number is not None or time is not None:
            raise click.UsageError(f"--frame and --time are for a run; {path} is one file.")
        source = load_image(path, math.radians(pitch or 0.0), math.radians(roll or 0.0))
    from rover_tools.explain.picture import explain
    from rover_tools.output import result_folder

    file = out or result_folder("explain", None) / "explain.png"
    explain(source, file)
    note(f"look at {file}")
