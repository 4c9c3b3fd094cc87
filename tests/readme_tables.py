"""Reads the tables of a README, to hold them against the code."""

from __future__ import annotations

from itertools import dropwhile, takewhile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def is_row(line: str) -> bool:
    return line.startswith("|")


def table(readme: Path, heading: str) -> list[dict[str, str]]:
    """The rows of the first table below a heading; cells by column, without their backquotes."""
    section = readme.read_text().split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = dropwhile(lambda line: not is_row(line), section.splitlines())
    rows = [
        [cell.strip().strip("`") for cell in line.strip().strip("|").split(" |")]
        for line in takewhile(is_row, lines)
    ]
    columns, _, *cells = rows
    return [dict(zip(columns, row, strict=True)) for row in cells]


def column(readme: Path, heading: str, name: str) -> list[str]:
    """One column of that table."""
    return [row[name] for row in table(readme, heading)]
