"""The rover's missions on the scoreboard."""

from __future__ import annotations

from collections.abc import Sequence

from rover_tools.evaluation.results import Result
from rover_tools.scoreboard.board import Board, Cell, number
from rover_tools.scoreboard.mission_run import failed_row, run_job
from rover_tools.scoreboard.rover_table import (
    LEGEND,
    Summary,
    has_all_samples,
    is_home,
    oracle_ratio,
)
from rover_tools.scoreboard.scatter import scatter_of
from rover_tools.scoreboard.store import Entry

TEXT, DETAIL = "text", "detail"
HEADINGS = (
    ("world", TEXT), ("strategy", TEXT), ("end", "text detail"), ("samples", ""),
    ("mapped [%]", ""), ("fidelity [%]", DETAIL), ("time [s]", ""), ("oracle [s]", DETAIL),
    ("ratio", ""), ("distance [m]", DETAIL), ("contacts", DETAIL), ("recoveries", DETAIL),
)  # fmt: skip


def _line(result: Result) -> str:
    title = f"  {result['world']} {result['strategy']}: {result['reason']}"
    if result["time"] is None:
        return title
    return (
        f"{title} after {result['time']:.0f} s, {result['samples_collected']} of "
        f"{result['samples_total']} samples, {result['percent_mapped']:.1f} % mapped"
    )


def _intro(entries: Sequence[Entry]) -> str:
    if not entries:
        return "0 missions."
    settings = entries[0].settings
    return (
        f"{len(entries)} missions, camera at {settings['fps']:g} frames per second, "
        f"given up after {settings['time_limit']:g} s of simulated time."
    )


def _cells(entry: Entry) -> list[Cell]:
    row = entry.result
    samples = Cell("failed", "", "bad", title=row["reason"])
    if not entry.failed:
        collected = row["samples_collected"]
        kind = "good" if has_all_samples(row) else "bad"
        samples = Cell(f"{collected} of {row['samples_total']}", str(collected), kind)
    end = f"text end detail {'good' if is_home(row) else 'bad'}"
    return [
        Cell(row["world"], f"{entry.group} {row['seed']:09d}", TEXT, link=entry.report),
        Cell(row["strategy"], kind=TEXT),
        Cell(row["reason"], kind=end),
        samples,
        number(row["percent_mapped"], 1),
        number(row["fidelity"], 1, DETAIL),
        number(row["time"], 0),
        number(row["oracle_time"], 0, DETAIL),
        number(oracle_ratio(row), 2),
        number(row["distance"], 0, DETAIL),
        number(row["contacts"], 0, DETAIL),
        number(row["recoveries"], 0, DETAIL),
    ]


def _caption(result: Result) -> tuple[str, str]:
    return f"{result['world']}, {result['strategy']}", (
        f"{result['reason']} after {result['time']:.0f} s, {result['samples_collected']} of "
        f"{result['samples_total']} samples, {result['percent_mapped']:.1f} % mapped"
    )


BOARD = Board(
    run=run_job,
    failed_row=failed_row,
    shared=("fps", "time_limit"),
    line=_line,
    summarise=Summary.of,
    legend=LEGEND,
    intro=_intro,
    compared="Strategies",
    headings=HEADINGS,
    cells=_cells,
    pictures="Maps against the truth",
    caption=_caption,
    scatter=scatter_of,
)
