"""The README is the package's contract."""

from __future__ import annotations

import re
from dataclasses import fields

import pytest
from rclpy.qos import QoSProfile
from readme_tables import ROOT, column, table

from rover_common.ros import qos
from rover_dashboard.config import DashboardConfig
from rover_dashboard.feed import SLOTS
from rover_dashboard.history import LOGS
from rover_dashboard.node import DashboardNode
from rover_decision.types import Request

README = ROOT / "rover_dashboard" / "README.md"
PACKAGE = ROOT / "rover_dashboard" / "rover_dashboard"
OF_EVERY_NODE = {"/rosout", "/parameter_events"}
PROFILES = {name: value for name, value in vars(qos).items() if isinstance(value, QoSProfile)}


def endpoints(of_node) -> set[tuple[str, str, str]]:
    """(topic, type, profile), but those of every node."""
    return {
        (
            endpoint.topic_name.lstrip("/"),
            f"{endpoint.msg_type.__module__.split('.')[0]}/{endpoint.msg_type.__name__}",
            next(name for name, value in PROFILES.items() if value is endpoint.qos_profile),
        )
        for endpoint in of_node
        if endpoint.topic_name not in OF_EVERY_NODE
    }


def listed(heading: str) -> set[tuple[str, str, str]]:
    return {(row["topic"], row["type"], row["QoS"]) for row in table(README, heading)}


@pytest.fixture
def node(ros) -> DashboardNode:
    return ros.add(DashboardNode, port=0)


def test_the_topics_are_the_nodes(node):
    assert listed("Subscribes") == endpoints(node.subscriptions)
    node.set_watched(True)
    both = listed("Subscribes") | listed("Subscribes while watched")
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
