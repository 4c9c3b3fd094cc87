"""The document shows the machine as it is."""

from __future__ import annotations

from readme_tables import ROOT, column

from rover_heat.mission.chart import State
from rover_heat.state_diagram import HEAT

DOCUMENT = ROOT / "docs" / "heat.md"


def test_the_document_is_up_to_date():
    document = DOCUMENT.read_text()
    assert HEAT.written_into(document) == document


def test_every_state_stands_beside_the_references():
    assert set(column(DOCUMENT, "States", "state")) == {state.name for state in State}
