"""The health of a team of nodes: who is silent, and which trouble is the cause of the others.

Times are [s] of any clock that does not fall back.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import IntEnum


class Level(IntEnum):
    """As in diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


@dataclass(frozen=True)
class Finding:
    """What a node says of one of its inputs, or of itself."""

    name: str  # of the input or the trouble
    level: Level
    text: str
    source: str = ""  # the node that may be to blame for it; empty for nobody else


@dataclass(frozen=True)
class Health:
    level: Level
    text: str  # the cause


@dataclass(frozen=True)
class _Report:
    heard: float  # [s]
    findings: tuple[Finding, ...]


class TeamHealth:
    """Hears the reports of all nodes of a team, which come several times a second."""

    def __init__(self, team: Sequence[str], silent_age: float) -> None:
        """team: names of nodes in the order of the data's flow; silent_age: [s] without a report
        after which a node that was heard before is silent.
        """
        self._team = tuple(team)
        self._silent_age = silent_age
        self._reports: dict[str, _Report] = {}

    def hear(self, node: str, findings: Iterable[Finding], now: float) -> None:
        """A report came; those of other nodes are left alone."""
        if node in self._team:
            troubles = tuple(each for each in findings if each.level > Level.OK)
            self._reports[node] = _Report(now, troubles)

    def speaker(self, now: float) -> str | None:
        """Who speaks for the team: the first one that is not silent."""
        return next((node for node in self._team if self._speaks(node, now)), None)

    def state(self, now: float) -> Health:
        """The worst of the team, and the trouble that it comes from."""
        found = {node: self._findings(node, now) for node in self._team}
        worst = max(
            ((node, each) for node in self._team for each in found[node]),
            key=lambda pair: pair[1].level,
            default=None,
        )
        if worst is None:
            return Health(Level.OK, "all nodes work")
        node, finding = worst
        level, seen = finding.level, {node}
        while finding.source in found and finding.source not in seen and found[finding.source]:
            node = finding.source
            seen.add(node)
            finding = max(found[node], key=lambda each: each.level)
        return Health(level, f"{node}: {_told(finding)}")

    def _findings(self, node: str, now: float) -> tuple[Finding, ...]:
        report = self._reports.get(node)
        if report is None:  # those that wait for it say so
            return ()
        age = now - report.heard
        if age > self._silent_age:
            return (Finding("", Level.ERROR, f"silent for {age:.1f} s"),)
        return report.findings

    def _speaks(self, node: str, now: float) -> bool:
        report = self._reports.get(node)
        return report is not None and now - report.heard <= self._silent_age


def _told(finding: Finding) -> str:
    return f"{finding.name}: {finding.text}" if finding.name else finding.text
