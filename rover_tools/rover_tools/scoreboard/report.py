"""The report of a result folder: one HTML page, which needs nothing but the folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rover_tools.report.pages import render
from rover_tools.scoreboard.scatter import KINDS, scatter_of
from rover_tools.scoreboard.store import Entry, write_whole
from rover_tools.scoreboard.table import (
    LEGEND,
    Summary,
    has_all_samples,
    is_home,
    oracle_ratio,
)

REPORT = "report.html"


def write_report(folder: Path, entries: Sequence[Entry], rows: Sequence[Summary]) -> None:
    """Write report.html; its pictures and the missions' reports are links into the folder."""
    page = render(
        "rover_tools.scoreboard", "scoreboard.html.j2",
        rows=[row.cells() for row in rows], legend=LEGEND, entries=entries,
        scatter=scatter_of(entries), kinds=KINDS,
        ratio=oracle_ratio, home=is_home, with_all_samples=has_all_samples,
    )  # fmt: skip
    write_whole(folder / REPORT, page.encode())
