"""Missions of a scoreboard and their results, made up."""

from __future__ import annotations

from pathlib import Path

from rover_tools.evaluation.mission_result import failed_result
from rover_tools.scoreboard.job import Job
from rover_tools.scoreboard.mission_run import failed_row
from rover_tools.scoreboard.rover_board import BOARD
from rover_tools.scoreboard.store import Entry, Store

FILES = {".svg": b"<svg/>", ".csv": b"time\n", ".html": b"<!doctype html>"}


def job_of(strategy="tour", seed=1, **changes) -> Job:
    values = {"ground": None, "size": 0.4, "fps": 12.5, "time_limit": 900.0} | changes
    return Job(strategy, seed, **values)


def row_of(job: Job, **changes) -> dict:
    """A mission that came home with everything in 200 s."""
    row = failed_result(job.world_name, job.strategy, job.seed, "")
    row |= {
        "done": True, "reason": "home", "time": 200.0, "percent_mapped": 98.0, "fidelity": 96.0,
        "f1": 97.0, "samples_collected": 6, "samples_total": 6, "home_distance": 1.5,
        "distance": 400.0, "contacts": 1, "recoveries": 2, "oracle_time": 100.0,
    }  # fmt: skip
    return row | changes


def entry_of(job: Job, **changes) -> Entry:
    return Entry(job.name, job.settings(), False, row_of(job, **changes))


def failed_entry(job: Job) -> Entry:
    return Entry(job.name, job.settings(), True, failed_row(job, RuntimeError("no way")))


def store_in(folder: Path) -> Store:
    return Store(folder, BOARD.shared)
