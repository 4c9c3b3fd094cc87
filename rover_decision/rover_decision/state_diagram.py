"""`python -m rover_decision.state_diagram docs/decision.md`: the machine, drawn into a document.

Writes a Mermaid diagram and a table of the events between the document's two markers.
"""

from __future__ import annotations

import sys
from pathlib import Path

from statemachine.contrib.diagram.extract import extract
from statemachine.contrib.diagram.renderers.mermaid import MermaidRenderer
from tabulate import tabulate

from rover_decision.missions.sample_return.chart import Event, MissionChart, transitions

BEGIN = "<!-- by python -m rover_decision.state_diagram, not by hand -->"
END = "<!-- end of what it wrote -->"


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    path = Path(arguments[0])
    path.write_text(written_into(path.read_text()))
    return 0


def written_into(document: str) -> str:
    """The document with the diagram and the table of today's machine; raises ValueError."""
    before, begin, rest = document.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        raise ValueError(f"the document lacks the lines {BEGIN} and {END}")
    return f"{before}{begin}\n\n```mermaid\n{diagram()}```\n\n{table()}\n\n{end}{after}"


def diagram() -> str:
    """Mermaid text."""
    return MermaidRenderer().render(extract(MissionChart)) + "\n"


def table() -> str:
    """Markdown: which event leads from where to where."""
    rows = []
    for event in Event:
        found = sorted(
            (t for t in transitions() if t.event is event), key=lambda t: (t.source, t.target)
        )
        sources = ", ".join(dict.fromkeys(t.source.name for t in found))
        targets = " or ".join(dict.fromkeys(t.target.name for t in found))
        rows.append((event.name, event.value, sources, targets))
    return tabulate(rows, ("event", "it says", "leads from", "to"), tablefmt="github")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
