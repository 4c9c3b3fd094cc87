"""The document shows the machine as it is."""

import re
from pathlib import Path

import pytest

from rover_decision import state_diagram
from rover_decision.states import Event, MissionMachine, State

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "decision.md"


def transitions_of(machine=MissionMachine) -> set[tuple[str, str, str]]:
    return {
        (State(source.value).name, event.id, State(transition.target.value).name)
        for source in machine.states
        for transition in source.transitions
        for event in transition.events
    }


def drawn() -> set[tuple[str, str, str]]:
    """All arrows of the diagram, those from a box taken apart."""
    text = state_diagram.diagram()
    boxes = dict(re.findall(r'state "(.*)" as (box\d+)', text))
    names = {box: names for names, box in boxes.items()}
    found = set()
    for start, target, events in re.findall(r"(\w+) --> (\w+) : (.*)", text):
        sources = names.get(start, start).split("<br>")
        if sources[0].startswith("any but "):
            left_out = {target, *sources[0].removeprefix("any but ").split(" or ")}
            sources = [state.name for state in State if state.name not in left_out]
        found |= {(source, event, target) for source in sources for event in events.split("<br>")}
    return found


def test_the_document_is_up_to_date():
    document = DOCUMENT.read_text()
    assert state_diagram.written_into(document) == document, state_diagram.__doc__


def test_the_diagram_has_each_transition_and_no_other():
    assert drawn() == transitions_of()
    assert "[*] --> IDLE" in state_diagram.diagram()


def test_the_table_has_each_event_with_its_meaning():
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in state_diagram.table().splitlines()[2:]
    ]
    assert [row[:2] for row in rows] == [[event.name, event.value] for event in Event]


def test_the_states_are_described_in_their_order():
    described = re.findall(r"^\| ([A-Z_]+) \|", DOCUMENT.read_text(), flags=re.MULTILINE)
    assert described == [state.name for state in State]


def test_it_writes_between_the_markers_and_nowhere_else(tmp_path, capsys):
    path = tmp_path / "page.md"
    path.write_text(f"before\n{state_diagram.BEGIN}\nold\n{state_diagram.END}\nafter\n")
    assert state_diagram.main([str(path)]) == 0
    written = path.read_text()
    assert written.startswith("before\n")
    assert written.endswith("\nafter\n")
    assert "old" not in written
    assert state_diagram.diagram() in written
    assert state_diagram.table() in written
    assert state_diagram.main([]) == 2
    with pytest.raises(ValueError, match="lacks the lines"):
        state_diagram.written_into("no markers")
