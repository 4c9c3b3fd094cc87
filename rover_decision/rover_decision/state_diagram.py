"""`python -m rover_decision.state_diagram docs/decision.md`: the machine, drawn into a document.

Writes a Mermaid diagram and a table of the events between the document's two markers.
"""

from __future__ import annotations

import sys
from collections.abc import Collection
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from statemachine import StateChart
from statemachine.contrib.diagram.extract import extract
from statemachine.contrib.diagram.renderers.mermaid import MermaidRenderer
from tabulate import tabulate

from rover_decision.missions.sample_return.chart import Event, MissionChart, transitions
from rover_decision.statechart import Transition

END = "<!-- end of what it wrote -->"


@dataclass(frozen=True)
class Drawing:
    """One mission's machine, and the module that draws it."""

    chart: type[StateChart]
    events: type[Enum]
    arrows: Collection[Transition[Any, Any]]
    module: str = "rover_decision.state_diagram"

    @property
    def begin(self) -> str:
        """The line after which it writes."""
        return f"<!-- by python -m {self.module}, not by hand -->"

    def write(self, arguments: list[str], usage: str | None) -> int:
        """Into the document named by the arguments; returns the exit code."""
        if len(arguments) != 1:
            print(usage, file=sys.stderr)
            return 2
        path = Path(arguments[0])
        path.write_text(self.written_into(path.read_text()))
        return 0

    def written_into(self, document: str) -> str:
        """The document with the diagram and the table of today's machine; raises ValueError."""
        before, begin, rest = document.partition(self.begin)
        _, end, after = rest.partition(END)
        if not end:
            raise ValueError(f"the document lacks the lines {self.begin} and {END}")
        drawn = f"```mermaid\n{self.diagram()}```\n\n{self.table()}"
        return f"{before}{begin}\n\n{drawn}\n\n{end}{after}"

    def diagram(self) -> str:
        """Mermaid text."""
        return MermaidRenderer().render(extract(self.chart)) + "\n"

    def table(self) -> str:
        """Markdown: which event leads from where to where."""
        rows = []
        for event in self.events:
            found = sorted(
                (t for t in self.arrows if t.event is event), key=lambda t: (t.source, t.target)
            )
            sources = ", ".join(dict.fromkeys(t.source.name for t in found))
            targets = " or ".join(dict.fromkeys(t.target.name for t in found))
            rows.append((event.name, event.value, sources, targets))
        return tabulate(rows, ("event", "it says", "leads from", "to"), tablefmt="github")


SAMPLE_RETURN = Drawing(MissionChart, Event, transitions())


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    return SAMPLE_RETURN.write(arguments, __doc__)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
