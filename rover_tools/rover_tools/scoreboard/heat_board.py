"""Heat missions on the scoreboard."""

from __future__ import annotations

from collections.abc import Sequence

from rover_tools.evaluation.results import Result
from rover_tools.scoreboard.board import Board, Cell, number
from rover_tools.scoreboard.heat_acceptance import FILE, acceptance_table
from rover_tools.scoreboard.heat_run import failed_heat_row, run_heat_job
from rover_tools.scoreboard.heat_table import LEGEND, HeatSummary, found_all
from rover_tools.scoreboard.store import Entry

TEXT, DETAIL = "text", "detail"
HEADINGS = (
    ("maze", TEXT), ("parameters", TEXT), ("success", ""), ("end", "text detail"), ("sources", ""),
    ("false", ""), ("delivered", ""), ("ramp", ""), ("contacts", ""), ("time [s]", ""),
    ("source [m]", DETAIL), ("launch [m]", DETAIL), ("ascent [m]", DETAIL), ("pose [m]", DETAIL),
    ("walls [%]", DETAIL),
)  # fmt: skip


def _told(row: Result) -> str:
    """Its end in some words."""
    if row["time"] is None:
        return str(row["reason"])
    return (
        f"{row['reason']} after {row['time']:.0f} s, {row['sources_found']} of "
        f"{row['sources_total']} sources found, {row['delivered']} delivered, "
        f"{row['contacts']} contacts"
    )


def _line(row: Result) -> str:
    mark = "success" if row["success"] else "no success"
    return f"  {row['world']} {row['parameters']}: {mark}, {_told(row)}"


def _intro(entries: Sequence[Entry]) -> str:
    return f"{len(entries)} heat missions, each in one process without ROS."


def _judged(text: str, good: bool) -> Cell:
    return Cell(text, kind="good" if good else "bad")


def _cells(entry: Entry) -> list[Cell]:
    row = entry.result
    first = [
        Cell(row["world"], f"{entry.group} {row['seed']:09d}", TEXT, link=entry.report),
        Cell(row["parameters"], kind=TEXT),
        _judged("yes" if row["success"] else "no", row["success"]),
        Cell(row["reason"], kind=f"text end detail {'good' if row['done'] else 'bad'}"),
    ]
    if entry.failed:
        return first + [Cell("-", "", kind) for _, kind in HEADINGS[len(first) :]]
    total, ramp = row["sources_total"], row["ramp_done"]
    return [
        *first,
        _judged(f"{row['sources_found']} of {total}", found_all(row)),
        _judged(str(row["sources_false"]), row["sources_false"] == 0),
        _judged(f"{row['delivered']} of {total}", row["delivered"] == total),
        _judged({True: "done", False: "not done", None: "none"}[ramp], ramp is not False),
        _judged(str(row["contacts"]), row["contacts"] == 0),
        number(row["time"], 0),
        number(row["source_error_max"], 3, DETAIL),
        number(row["launch_error_max"], 3, DETAIL),
        number(row["early_ascent"], 3, DETAIL),
        number(row["pose_rmse"], 3, DETAIL),
        number(row["walls_right"], 1, DETAIL),
    ]


def _caption(row: Result) -> tuple[str, str]:
    return f"{row['world']}, {row['parameters']}", _told(row)


HEAT_BOARD = Board(
    run=run_heat_job,
    failed_row=failed_heat_row,
    shared=(),
    line=_line,
    summarise=HeatSummary.of,
    legend=LEGEND,
    intro=_intro,
    compared="Parameters",
    headings=HEADINGS,
    cells=_cells,
    pictures="Mazes and maps",
    caption=_caption,
    texts=lambda rows: {FILE: acceptance_table(rows)},
)
