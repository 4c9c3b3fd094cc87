"""The report of a result folder: one HTML page, which needs nothing but the folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

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
    """Write report.html; its pictures are links into the folder."""
    environment = Environment(
        loader=PackageLoader("rover_tools.scoreboard", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    tests = {"home": is_home, "with_all_samples": has_all_samples}
    page = environment.get_template("report.html.j2").render(
        rows=[row.cells() for row in rows], legend=LEGEND, entries=entries,
        ratio=oracle_ratio, **tests,
    )  # fmt: skip
    write_whole(folder / REPORT, page.encode())
