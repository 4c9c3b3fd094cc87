"""The health of the team names the cause of the worst trouble, and who is silent."""

from __future__ import annotations

import pytest

from rover_common.health import Finding, Health, Level, TeamHealth

BRIDGE, PERCEPTION, DECISION = "bridge_node", "perception_node", "decision_node"
TEAM = (BRIDGE, PERCEPTION, DECISION)
SILENT = 0.7  # [s]
NO_COMMAND = Finding("cmd_drive", Level.ERROR, "none for 1.0 s", DECISION)
NO_POLAR = Finding("nav_polar", Level.ERROR, "none for 1.0 s", PERCEPTION)
NO_IMAGE = Finding("image", Level.ERROR, "none for 1.0 s", BRIDGE)


def heard(**findings: list[Finding]) -> TeamHealth:
    """All have reported at 10 s."""
    health = TeamHealth(TEAM, SILENT)
    for node in TEAM:
        health.hear(node, findings.get(node, []), 10.0)
    return health


def test_a_team_without_trouble_is_well():
    well = Finding("image", Level.OK, "25.0 messages/s", BRIDGE)
    assert heard(perception_node=[well]).state(10.1) == Health(Level.OK, "all nodes work")


def test_who_was_not_heard_yet_is_for_those_to_name_that_wait_for_it():
    health = TeamHealth(TEAM, SILENT)
    health.hear(BRIDGE, [Finding("peers", Level.WARN, "waiting for decision")], 10.0)
    assert health.state(10.1) == Health(Level.WARN, "bridge_node: peers: waiting for decision")


@pytest.mark.parametrize("stopped", TEAM)
def test_a_silent_node_is_the_cause_of_all_that_follows_from_it(stopped):
    health = TeamHealth(TEAM, SILENT)
    consequences = {BRIDGE: NO_COMMAND, PERCEPTION: NO_IMAGE, DECISION: NO_POLAR}
    for node in TEAM:
        health.hear(node, [], 10.0)
    for node in set(TEAM) - {stopped}:
        health.hear(node, [consequences[node]], 11.0)
    assert health.state(11.0) == Health(Level.ERROR, f"{stopped}: silent for 1.0 s")


def test_the_cause_is_followed_to_the_node_that_has_one_of_its_own():
    no_frame = Finding("frames", Level.ERROR, "none usable for 1.0 s: no pose")
    health = heard(
        bridge_node=[NO_COMMAND], perception_node=[no_frame], decision_node=[NO_POLAR]
    )  # fmt: skip
    state = health.state(10.1)
    assert state.text == "perception_node: frames: none usable for 1.0 s: no pose"


def test_a_source_without_trouble_leaves_the_blame_where_it_was_found():
    state = heard(bridge_node=[NO_COMMAND]).state(10.1)
    assert state == Health(Level.ERROR, "bridge_node: cmd_drive: none for 1.0 s")


def test_a_circle_of_blame_ends():
    health = heard(
        bridge_node=[NO_COMMAND], perception_node=[NO_IMAGE], decision_node=[NO_POLAR]
    )  # fmt: skip
    assert health.state(10.1).level is Level.ERROR


def test_an_error_is_worse_than_a_warning():
    slow = Finding("image", Level.WARN, "2.0 messages/s", "camera")
    state = heard(bridge_node=[slow], decision_node=[NO_POLAR]).state(10.1)
    assert state.text == "decision_node: nav_polar: none for 1.0 s"


def test_one_node_speaks_the_first_that_is_heard():
    health = heard()
    assert health.speaker(10.1) == BRIDGE
    health.hear(DECISION, [], 11.0)
    assert health.speaker(11.0) == DECISION
    assert health.speaker(20.0) is None


def test_other_nodes_do_not_count():
    health = heard()
    health.hear("recorder_node", [Finding("disk", Level.ERROR, "full")], 10.0)
    assert health.state(10.1).level is Level.OK
