"""`rover demo`: a drive of the project's own, through the wire, the graph and the scoring.

Frames are rendered by the camera model over a generated canyon and played to the bridge as the
Unity simulator would send them.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from rover_bringup.command import run_command
from rover_bringup.replay import OVERRIDES, replay
from rover_bringup.results import Truth, summary
from rover_bringup.run import note, result_folder, running_graph
from rover_simulator.recording import read_recording


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    options = _parser().parse_args(arguments)
    return run_command("demo", lambda: _demo(options))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="rover demo", description=__doc__)
    add = parser.add_argument
    add("--seed", type=int, default=1, help="of the canyon (default: %(default)s)")
    add("--frames", type=int, default=300, help="length of the drive (default: %(default)s)")
    add("--out", type=Path, metavar="DIR", help="result folder (default: a new one in ./results)")
    add("--json", action="store_true", help="print the result as one JSON object")
    return parser


def _demo(options: argparse.Namespace) -> None:
    from rover_simulator.recorder import record_drive  # renders: slow to import

    folder = result_folder("demo", options.out)
    note(f"rendering a drive of {options.frames} frames through canyon {options.seed}")
    drive = record_drive(folder / "drive", options.seed, options.frames)
    truth = Truth.load(drive.truth, drive.samples)
    with running_graph(folder, OVERRIDES) as run:
        result = replay(read_recording(drive.folder), run, truth, 2, f"canyon {options.seed}")
    print(json.dumps(result) if options.json else summary(result))
    note(
        f"drove {result['frames']} frames through the graph and mapped "
        f"{result['percent_mapped']} % of the canyon at {result['fidelity']} % fidelity; "
        f"look at {folder / 'map.png'}"
    )
