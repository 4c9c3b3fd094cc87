"""The READMEs of the decision and navigation packages are contracts."""

from __future__ import annotations

from dataclasses import fields

import pytest
from node_endpoints import endpoints, listed
from readme_tables import ROOT, column, table

from rover_common.input_monitor import InputLimits
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.node import DecisionNode
from rover_decision.trouble import Trouble
from rover_decision.types import Request

README = ROOT / "rover_decision" / "README.md"
NAVIGATION = ROOT / "rover_navigation" / "README.md"
DOCUMENT = ROOT / "docs" / "decision.md"


@pytest.mark.parametrize("heading", ["Publishes", "Subscribes"])
def test_the_topics_are_the_nodes(ros, heading):
    node = ros.add(DecisionNode)
    found = endpoints(node.publishers if heading == "Publishes" else node.subscriptions)
    assert listed(README, heading) == found


def test_the_services_are_the_nodes(ros):
    node = ros.add(DecisionNode)
    names = {service.srv_name.rsplit("/", 1)[-1] for service in node.services}
    text = README.read_text()
    for request in Request:
        assert request.value in names
        assert f"`~/{request.value}`" in text


def test_the_parameters_are_those_of_the_configuration():
    rows = table(README, "Parameters")
    declared = [*fields(DecisionConfig), *fields(InputLimits)]
    assert [row["parameter"] for row in rows] == [field.name for field in declared]
    for row, field in zip(rows, declared, strict=True):
        info = field.metadata["parameter"]
        limits = f"{info.minimum} to {info.maximum}"
        choices = ", ".join(getattr(info.choices, "own", info.choices))
        assert row["default"] == str(field.default), field.name
        limits = "" if info.minimum is None else limits
        assert row["range"].replace("`", "") == (choices or limits), field.name


def test_every_module_of_navigation_is_described():
    modules = {path.name for path in (ROOT / "rover_navigation" / "rover_navigation").glob("*.py")}
    text = NAVIGATION.read_text()
    assert {name for name in modules if f"`{name}`" in text} == modules - {"__init__.py"}


def test_every_state_and_every_trouble_is_described():
    assert column(DOCUMENT, "States", "state") == [state.name for state in State]
    assert column(DOCUMENT, "Trouble", "trouble") == [trouble.name for trouble in Trouble]
