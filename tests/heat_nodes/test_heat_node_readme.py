"""The README of the heat mission lists what its node publishes, subscribes and serves."""

from __future__ import annotations

import pytest
from node_endpoints import endpoints, listed
from readme_tables import ROOT, column

from rover_common import topics
from rover_heat.node import HeatNode

README = ROOT / "rover_heat" / "README.md"
LATE = (topics.MISSION_TICK, "std_msgs/Header", "CONTROL")  # once navigator and robot are there


@pytest.fixture
def node(ros) -> HeatNode:
    return ros.add(HeatNode, stamped_cmd_vel="true", lockstep=True)


def test_the_readme_lists_its_topics(node):
    assert listed(README, "Publishes") == endpoints(node.publishers) | {LATE}
    assert listed(README, "Subscribes") == endpoints(node.subscriptions)


def test_the_readme_lists_its_services(node):
    rows = column(README, "Services and actions", "name")
    names = [name.strip("` ") for row in rows for name in row.split(",")]
    served = [each.srv_name for each in node.services if each.srv_name.startswith("~")]
    assert [name for name in names if name.startswith("~")] == [*served, "~/run_mission"]
