"""The document shows the machine as it is."""

import re
from pathlib import Path

import pytest

from rover_decision import state_diagram
from rover_decision.missions.sample_return.chart import Event, State, transitions
from rover_decision.state_diagram import END, SAMPLE_RETURN

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "decision.md"


def drawn() -> set[tuple[str, str, str]]:
    """All arrows between two names of the diagram, with what stands on them."""
    return set(re.findall(r"^\s*(\w+) --> (\w+) : (.*)$", SAMPLE_RETURN.diagram(), re.MULTILINE))


def test_the_document_is_up_to_date():
    document = DOCUMENT.read_text()
    assert SAMPLE_RETURN.written_into(document) == document, state_diagram.__doc__


def test_the_diagram_has_each_state_and_each_event():
    diagram = SAMPLE_RETURN.diagram()
    for state in State:
        assert re.search(rf"\b{state.name.lower()}\b", diagram), state
    events = {event for _, _, label in drawn() for event in re.split(r", | / ", label)}
    assert events == {event.name.replace("_", " ").capitalize() for event in Event}


def test_the_diagram_has_the_arrows_between_single_states():
    names = {state.name.lower() for state in State}
    for source, target, label in drawn():
        if source in names and target in names:
            found = {
                arrow.event.name.replace("_", " ").capitalize()
                for arrow in transitions()
                if (arrow.source.name.lower(), arrow.target.name.lower()) == (source, target)
            }
            assert set(re.split(r", | / ", label)) <= found


def test_the_table_has_each_event_with_its_meaning_and_its_states():
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in SAMPLE_RETURN.table().splitlines()[2:]
    ]
    assert [row[:2] for row in rows] == [[event.name, event.value] for event in Event]
    for event, (_, _, sources, targets) in zip(Event, rows, strict=True):
        arrows = [arrow for arrow in transitions() if arrow.event is event]
        assert set(sources.split(", ")) == {arrow.source.name for arrow in arrows}
        assert set(targets.split(" or ")) == {arrow.target.name for arrow in arrows}


def test_the_states_are_described_in_their_order():
    described = re.findall(r"^\| ([A-Z_]+) \|", DOCUMENT.read_text(), flags=re.MULTILINE)
    assert described == [state.name for state in State]


def test_it_writes_between_the_markers_and_nowhere_else(tmp_path):
    path = tmp_path / "page.md"
    path.write_text(f"before\n{SAMPLE_RETURN.begin}\nas before\n{END}\nafter\n")
    assert state_diagram.main([str(path)]) == 0
    written = path.read_text()
    assert written.startswith("before\n")
    assert written.endswith("\nafter\n")
    assert "as before" not in written
    assert SAMPLE_RETURN.diagram() in written
    assert SAMPLE_RETURN.table() in written
    assert state_diagram.main([]) == 2
    with pytest.raises(ValueError, match="lacks the lines"):
        SAMPLE_RETURN.written_into("no markers")
