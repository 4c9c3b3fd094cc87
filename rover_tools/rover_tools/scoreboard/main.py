"""`rover scoreboard`: fly many missions, and see which strategy does what how often.

Every strategy flies in every world, each mission in one process, without ROS: the same mission as
`rover mission` flies it, frame for frame. A table is printed; the result folder holds a report
(report.html), and a picture and a JSON file per mission. Run it again with the same --out, and
only what is missing is flown.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Sequence
from pathlib import Path

from tqdm import tqdm

from rover_simulator.main import FPS, fps_option
from rover_tools.cli.errors import run_command
from rover_tools.evaluation.strategy import SYNTAX, Strategy
from rover_tools.runner.run import note, result_folder
from rover_tools.scoreboard.cluster import Outcome, cluster, fly_all
from rover_tools.scoreboard.errors import ScoreboardError
from rover_tools.scoreboard.job import Ground, Job, make_jobs, parse_seeds
from rover_tools.scoreboard.mission_run import Flown, failed_row
from rover_tools.scoreboard.report import write_report
from rover_tools.scoreboard.store import Store
from rover_tools.scoreboard.table import as_text, summaries

EXAMPLES = """examples:
  rover scoreboard                                              a small one, in some minutes
  rover scoreboard --worlds 1-20 --strategies tour,frontier     two strategies in 20 canyons
  rover scoreboard --map canyon.png --seeds 1-20                one map, samples drawn 20 times
  rover scoreboard --worlds 1-20 --out results/s1               again: goes on where it stopped
"""
DEFAULT_WORLDS = "1-4"


def main(arguments: list[str]) -> int:
    """Returns the exit code: 0, or 1 when missions failed or an option cannot be met."""
    options = parser().parse_args(arguments)
    return run_command("scoreboard", lambda: _scoreboard(options))


def parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="rover scoreboard",
        description=__doc__,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    _add_missions(parser.add_argument_group("which missions"))
    _add_how(parser.add_argument_group("how"))
    return parser


def _add_missions(group: argparse._ArgumentGroup) -> None:
    add = group.add_argument
    add("--worlds", type=parse_seeds, metavar="SEEDS",
        help="generated canyons, as 101-140 or 1,5,9 "
        f"(default: {DEFAULT_WORLDS}, or none with --map)")  # fmt: skip
    add("--map", type=Path, metavar="PNG",
        help="a map of 200 x 200 pixels too, white is ground")  # fmt: skip
    add("--seeds", type=parse_seeds, default="1-4", metavar="SEEDS",
        help="that draw the samples on the map (default: %(default)s)")  # fmt: skip
    add("--strategies", type=_strategies, default=str(Strategy()), metavar="NAMES",
        help=f"separated by commas, each {SYNTAX} (default: %(default)s)")  # fmt: skip
    add("--size", type=_positive, default=1.0,
        help="of generated canyons, 1 as large as the original (default: %(default)s)")  # fmt: skip
    add("--fps", type=fps_option, default=FPS,
        help="of the camera, made 50 over a whole number (default: %(default)s)")  # fmt: skip
    add("--time-limit", type=_positive, default=900.0, metavar="S",
        help="give a mission up after this simulated time [s] (default: %(default)s)")  # fmt: skip


def _add_how(group: argparse._ArgumentGroup) -> None:
    add = group.add_argument
    add("--workers", type=_count, metavar="N",
        help="processes on this machine (default: one per core)")  # fmt: skip
    add("--scheduler", metavar="ADDRESS",
        help="of a Dask scheduler that runs already, as tcp://host:8786, instead")  # fmt: skip
    add("--out", type=Path, metavar="DIR", help="result folder (default: a new one in ./results)")
    add("--json", action="store_true",
        help="print a list of the missions' results instead of the table")  # fmt: skip


def _scoreboard(options: argparse.Namespace) -> None:
    jobs = _jobs(options)
    store = Store(result_folder("scoreboard", options.out))
    left = store.left(jobs)
    note(f"{len(jobs)} missions, {len(jobs) - len(left)} flown before; results in {store.folder}")
    try:
        if left:
            _fly(options, store, left, len(jobs))
    except KeyboardInterrupt:
        note(f"to go on, run it again with --out {store.folder}")
        raise
    finally:
        table = _write_report(store)
    names = {job.name for job in jobs}
    entries = [entry for entry in store.entries() if entry.name in names]
    print(json.dumps([entry.result for entry in entries]) if options.json else table)
    note(f"look at {store.folder / 'report.html'}")
    if failed := sum(entry.failed for entry in entries):
        raise ScoreboardError(
            f"{failed} of {len(entries)} missions failed; they are flown again with "
            f"--out {store.folder}"
        )


def _jobs(options: argparse.Namespace) -> list[Job]:
    worlds = options.worlds
    if worlds is None:
        worlds = [] if options.map else parse_seeds(DEFAULT_WORLDS)
    return make_jobs(
        worlds, None if options.map is None else Ground.load(options.map), options.seeds,
        options.strategies, size=options.size, fps=options.fps, time_limit=options.time_limit,
    )  # fmt: skip


def _fly(options: argparse.Namespace, store: Store, left: Sequence[Job], total: int) -> None:
    with (
        cluster(options.scheduler, options.workers, len(left)) as client,
        tqdm(total=total, initial=total - len(left), unit="mission", disable=None) as bar,
    ):
        bar.refresh()
        try:
            for job, outcome in fly_all(client, left):
                _take(store, job, outcome)
                bar.update()
        except KeyboardInterrupt:
            note("stopping; the missions in the air are lost")
            raise


def _take(store: Store, job: Job, outcome: Outcome) -> None:
    """Keep what came back, and say so."""
    if isinstance(outcome, Flown):
        result, picture = outcome.result, outcome.picture
    else:
        result, picture = failed_row(job, outcome), None
    store.add(job, result, picture)
    with tqdm.external_write_mode():
        note(_line(result))


def _line(result: dict) -> str:
    """One mission in one line."""
    title = f"  {result['world']} {result['strategy']}: {result['reason']}"
    if result["time"] is None:
        return title
    return (
        f"{title} after {result['time']:.0f} s, {result['samples_collected']} of "
        f"{result['samples_total']} samples, {result['percent_mapped']:.1f} % mapped"
    )


def _write_report(store: Store) -> str:
    """Of all missions that the folder holds; returns the table as text."""
    entries = store.entries()
    rows = summaries(entries)
    write_report(store.folder, entries, rows)
    return as_text(rows)


def _strategies(text: str) -> list[str]:
    """Each once, by its shortest name."""
    return list(dict.fromkeys(str(Strategy.parse(part)) for part in text.split(",")))


def _positive(text: str) -> float:
    value = float(text)
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError("a positive number")
    return value


def _count(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("1 or more")
    return value
