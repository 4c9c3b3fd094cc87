"""The report of a result folder: one HTML page, which needs nothing but the folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rover_common.whole_file import write_whole
from rover_tools.report.pages import render
from rover_tools.scoreboard.board import Board, Summary
from rover_tools.scoreboard.scatter import KINDS
from rover_tools.scoreboard.store import Entry

REPORT = "report.html"


def write_report(
    folder: Path, board: Board, entries: Sequence[Entry], rows: Sequence[Summary]
) -> None:
    """Write report.html, and the board's own texts.

    The page's pictures and the missions' reports are links into the folder.
    """
    page = render(
        "rover_tools.scoreboard", "scoreboard.html.j2",
        board=board, rows=[row.cells() for row in rows], entries=entries,
        scatter=board.scatter(entries), kinds=KINDS,
    )  # fmt: skip
    write_whole(folder / REPORT, page)
    for name, text in board.texts(rows).items():
        write_whole(folder / name, text)
