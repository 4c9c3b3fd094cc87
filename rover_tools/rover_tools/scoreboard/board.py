"""What one kind of missions brings to the scoreboard; the rest is the same for all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from tabulate import tabulate

from rover_tools.evaluation.results import Result
from rover_tools.scoreboard.missions import CompletedMission
from rover_tools.scoreboard.scatter import Scatter
from rover_tools.scoreboard.store import Entry


@dataclass(frozen=True)
class Cell:
    """One value in the page's list of missions."""

    text: str
    sort: str | None = None  # what it is sorted by, instead of its text
    kind: str = ""  # its class in the style sheet
    title: str = ""
    link: str | None = None


class Summary(Protocol):
    """The figures of one strategy in one group of worlds."""

    def cells(self) -> dict[str, str]:
        """What is shown, by its heading."""


@dataclass(frozen=True)
class Board:
    """One kind of missions."""

    run: Callable[[Any], CompletedMission]  # on the machine that this is called on
    failed_row: Callable[[Any, BaseException], Result]  # of a job that raised
    shared: tuple[str, ...]  # settings that all missions of a result folder have in common
    line: Callable[[Result], str]  # one mission in one line
    summarise: Callable[[str, str, Sequence[Entry]], Summary]  # of a strategy and a group
    legend: str  # below the table
    intro: Callable[[Sequence[Entry]], str]  # the page's first line
    compared: str  # heading of the page's table
    headings: tuple[tuple[str, str], ...]  # of the list of missions, each with its class
    cells: Callable[[Entry], list[Cell]]  # of a mission, below these headings
    pictures: str  # heading of the missions' pictures
    caption: Callable[[Result], tuple[str, str]]  # of a mission's picture: title and text
    scatter: Callable[[Sequence[Entry]], Scatter | None] = lambda _: None
    texts: Callable[[Sequence[Any]], dict[str, str]] = lambda _: {}  # of the summaries, by file


def summaries(board: Board, entries: Sequence[Entry]) -> list[Summary]:
    """By group of worlds, then by strategy."""
    kinds = sorted({(entry.group, entry.strategy) for entry in entries})
    return [
        board.summarise(
            strategy, group, [e for e in entries if (e.group, e.strategy) == (group, strategy)]
        )
        for group, strategy in kinds
    ]


def as_text(rows: Sequence[Summary], legend: str) -> str:
    """One column per strategy and group, so that many of them fit beside each other."""
    cells = [row.cells() for row in rows]
    if not cells:
        return "no missions"
    lines = [[heading, *(column[heading] for column in cells)] for heading in cells[0]]
    return tabulate(lines[1:], headers=lines[0], disable_numparse=True) + f"\n\n{legend}"


def number(value: float | None, digits: int, kind: str = "") -> Cell:
    """A cell with a number; - for none."""
    if value is None:
        return Cell("-", "", kind)
    return Cell(f"{value:.{digits}f}", str(value), kind)
