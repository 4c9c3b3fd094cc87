"""`python -m rover_decision.state_diagram docs/decision.md`: the machine, drawn into a document.

Writes a Mermaid diagram and a table of the events between the document's two markers.
"""

from __future__ import annotations

import sys
from pathlib import Path

from statemachine.contrib.diagram.model import (
    DiagramGraph,
    DiagramState,
    DiagramTransition,
    StateType,
)
from statemachine.contrib.diagram.renderers.mermaid import MermaidRenderer
from tabulate import tabulate

from rover_decision.missions.sample_return.chart import Event, MissionChart, State

BEGIN = "<!-- by python -m rover_decision.state_diagram, not by hand -->"
END = "<!-- end of what it wrote -->"
# An event that leads to one state from so many is drawn once, from a box with their names: an arrow
# from each of them would hide the others.
MANY = 4
FEW = 2  # so many that an event does not come from are named instead
BOX_STYLE = "fill:none,stroke-dasharray:4"


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
    boxes: dict[str, str] = {}  # their ids by their texts
    labels: dict[tuple[str, str], list[str]] = {}  # events by the arrow that they share
    for (event, end), sources in _transitions().items():
        starts = [source.name for source in sources]
        if len(starts) >= MANY:
            text = _together(sources, end, "<br>")
            starts = [boxes.setdefault(text, f"box{len(boxes) + 1}")]
        for start in starts:
            labels.setdefault((start, end.name), []).append(event.name)
    initial = State(MissionMachine.initial_state.value)
    graph = DiagramGraph(
        MissionMachine.name,
        [
            DiagramState(state.name, state.name, StateType.REGULAR, is_initial=state is initial)
            for state in State
        ]
        + [DiagramState(box, text, StateType.REGULAR) for text, box in boxes.items()],
        [
            DiagramTransition(start, [target], "<br>".join(events))
            for (start, target), events in labels.items()
        ],
    )
    style = [f"    classDef box {BOX_STYLE}", *(f"    class {box} box" for box in boxes.values())]
    return MermaidRenderer().render(graph) + "\n".join(style) + "\n"


def table() -> str:
    """Markdown: which event leads from where to where."""
    rows = [
        (event.name, event.value, _together(sources, target, ", "), target.name)
        for event in Event
        for (other, target), sources in _transitions().items()
        if other is event
    ]
    return tabulate(rows, ("event", "it says", "leads from", "to"), tablefmt="github")


def _transitions() -> dict[tuple[Event, State], list[State]]:
    """Where each event leads from, in the order of the states: so few arrows cross."""
    found: dict[tuple[Event, State], list[State]] = {}
    for source in sorted(MissionMachine.states, key=lambda state: state.value):
        for transition in source.transitions:
            for event in transition.events:
                key = (Event[event.id], State(transition.target.value))
                found.setdefault(key, []).append(State(source.value))
    return found


def _together(sources: list[State], target: State, separator: str) -> str:
    others = [state.name for state in State if state not in (*sources, target)]
    if len(sources) >= MANY and len(others) <= FEW:
        return "any but " + " or ".join(others)
    return separator.join(source.name for source in sources)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
