"""Run the missions that a result folder lacks, and report all of them."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tqdm import tqdm

from rover_tools.output import note, print_result
from rover_tools.progress import Progress
from rover_tools.scoreboard.board import Board, as_text, summaries
from rover_tools.scoreboard.cluster import Outcome, cluster, run_all
from rover_tools.scoreboard.errors import ScoreboardError
from rover_tools.scoreboard.missions import CompletedMission, MissionJob
from rover_tools.scoreboard.report import write_report
from rover_tools.scoreboard.store import Store


@dataclass(frozen=True)
class Engine:
    """Where the missions run."""

    scheduler: str | None  # address of a Dask scheduler; None: processes on this machine
    workers: int | None  # processes on this machine; None: one per core


def run_scoreboard(
    jobs: Sequence[MissionJob], board: Board, folder: Path, engine: Engine, as_json: bool
) -> None:
    """Run what the folder lacks, write its report, and print the results of these jobs.

    Raises ScoreboardError when missions failed, or when the folder cannot take these jobs.
    """
    store = Store(folder, board.shared)
    missing = store.missing(jobs)
    note(f"{len(jobs)} missions, {len(jobs) - len(missing)} already completed; results in {folder}")
    try:
        if missing:
            _run(board, engine, store, missing, len(jobs))
    except KeyboardInterrupt:
        note(f"to continue, run it again with --out {folder}")
        raise
    finally:
        table = _write_report(board, store)
    names = {job.name for job in jobs}
    entries = [entry for entry in store.entries() if entry.name in names]
    print_result([entry.result for entry in entries], as_json, table)
    note(f"look at {folder / 'report.html'}")
    if failed := sum(entry.failed for entry in entries):
        raise ScoreboardError(
            f"{failed} of {len(entries)} missions failed; they run again with --out {folder}"
        )


def _run(
    board: Board, engine: Engine, store: Store, missing: Sequence[MissionJob], total: int
) -> None:
    start = time.monotonic()
    with (
        cluster(engine.scheduler, engine.workers, len(missing)) as client,
        Progress(total, "missions") as progress,
    ):
        completed = total - len(missing)

        def show() -> None:
            progress.show(completed, f"{time.monotonic() - start:.0f} s, completed")

        try:
            outcomes = run_all(client, missing, board.run, on_start=note, while_waiting=show)
            for job, outcome in outcomes:
                _keep(board, store, job, outcome)
                completed += 1
                show()
        except KeyboardInterrupt:
            note("stopping; the missions in progress are lost")
            raise


def _keep(board: Board, store: Store, job: MissionJob, outcome: Outcome) -> None:
    """Write a mission's outcome into the folder, and print a line about it."""
    if isinstance(outcome, CompletedMission):
        store.add(job, result := outcome.result, outcome.files)
    else:
        store.add(job, result := board.failed_row(job, outcome), None)
    with tqdm.external_write_mode():
        note(board.line(result))


def _write_report(board: Board, store: Store) -> str:
    """Report all missions that the folder holds; returns the table as text."""
    entries = store.entries()
    rows = summaries(board, entries)
    write_report(store.folder, board, entries, rows)
    return as_text(rows, board.legend)
