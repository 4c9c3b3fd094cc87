"""What a long run has tried, and how fast."""

from __future__ import annotations

from typing import Any

from cases import LONG, TALLY


def pytest_terminal_summary(terminalreporter: Any) -> None:
    if not LONG:
        return
    stats = terminalreporter.stats
    took = {
        report.nodeid: report.duration
        for report in [*stats.get("passed", []), *stats.get("failed", [])]
        if report.when == "call"
    }
    for test, count in sorted(TALLY.items()):
        rate = f"{count / took[test]:8.0f} cases/s" if took.get(test) else ""
        terminalreporter.write_line(f"{count:8d} {rate}  {test.partition('::')[2]}")
    terminalreporter.write_line(f"{sum(TALLY.values()):8d} cases in all")
