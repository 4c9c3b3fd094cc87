"""The README is the package's contract."""

from __future__ import annotations

import re
from dataclasses import fields

import pytest
from node_endpoints import endpoints, listed
from readme_tables import ROOT, column, table

from rover_dashboard.config import DashboardConfig
from rover_dashboard.feed import SLOTS
from rover_dashboard.history import LOGS
from rover_dashboard.node import DashboardNode
from rover_decision.types import Request

README = ROOT / "rover_dashboard" / "README.md"
PACKAGE = ROOT / "rover_dashboard" / "rover_dashboard"


@pytest.fixture
def node(ros) -> DashboardNode:
    return ros.add(DashboardNode, port=0)


def test_the_topics_are_the_nodes(node):
    assert listed(README, "Subscribes") == endpoints(node.subscriptions)
    node.set_watched(True)
    both = listed(README, "Subscribes") | listed(README, "Subscribes while watched")
    assert both == endpoints(node.subscriptions)
    assert endpoints(node.publishers) == set()


def test_the_services_are_those_that_the_node_calls(node):
    section = README.read_text().split("## Services that it calls\n")[1].split("\n## ")[0]
    named = set(re.findall(r"`~/(\w+)`", section))
    assert named == {client.srv_name.rsplit("/", 1)[-1] for client in node.clients}
    assert named >= {request.value for request in Request}


def test_the_parameters_are_those_of_the_configuration():
    rows = table(README, "Parameters")
    assert [row["parameter"] for row in rows] == [field.name for field in fields(DashboardConfig)]
    for row, field in zip(rows, fields(DashboardConfig), strict=True):
        info = field.metadata["parameter"]
        limits = "" if info.minimum is None else f"{info.minimum} to {info.maximum}"
        assert (row["default"], row["range"]) == (str(field.default), limits)
        assert row["meaning"] == info.description


def test_the_slots_are_those_of_the_protocol():
    assert set(column(README, "Protocol", "slot")) == {*LOGS, *SLOTS, "settings", "answer"}


def test_the_flow_names_all_modules():
    flow = README.read_text().split("## The flow of one message\n")[1].split("\n## ")[0]
    modules = {path.name for path in PACKAGE.glob("*.py")}
    assert {name for name in modules if f"`{name}`" in flow} == modules - {
        "__init__.py",
        "config.py",
    }
