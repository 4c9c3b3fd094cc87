"""The result of a mission with faults: what came, what was lost, and the verdict."""

from __future__ import annotations

import csv
import json

import pytest

from rover_tools.chaos.executor import Outcome
from rover_tools.chaos.losses import Loss
from rover_tools.chaos.outcome import chaos_result, fault_line, unharmed, write_faults
from rover_tools.chaos.plan import Fault, Kind
from rover_tools.cli.main import main

HOME = {"done": True, "home_distance": 1.2, "samples_collected": 6, "samples_total": 6}
MAP = Loss("map", "1000 known cells became 12")
STOP = Outcome(Fault(1, 8.0, Kind.STOP, "bridge_node", 2.5), 8.1, 10.7, 0.4)
KILL = Outcome(Fault(2, 14.0, Kind.KILL, "decision_node", 0.0), 14.2, 14.3, 3.25, [MAP])
LAST = Outcome(Fault(3, 21.0, Kind.KILL, "decision_node", 0.0), 21.0, 21.1)
SIMULATED = {"longest_unbraked": 0.48, "dead_man_stops": 2, "time": 99.0}


def result(*outcomes: Outcome, at_end: tuple[Loss, ...] = (), **changes: object) -> dict:
    respawns = {"decision_node": 2, "perception_node": 1}
    return chaos_result(HOME | changes, outcomes, at_end, respawns, SIMULATED)


def test_the_result_counts_faults_and_names_losses():
    found = result(STOP, KILL, LAST, at_end=(Loss("home", "it is wrong"),))
    assert found["faults"] == 3
    assert found["faults_by_kind"] == {"stop": 1, "kill": 2}
    assert found["lost"] == [
        "fault 2, kill decision_node: map: 1000 known cells became 12",
        "at the end: home: it is wrong",
    ]
    assert (found["worst_brake_ms"], found["dead_man_stops"]) == (480, 2)
    assert found["worst_recovery_s"] == 3.2
    assert found["ended_by_themselves"] == {"perception_node": 1}
    assert json.loads(json.dumps(found)) == found


def test_a_mission_without_faults_has_no_figures_of_them():
    found = chaos_result(HOME, [], [], {}, {})
    assert (found["faults"], found["lost"], found["worst_recovery_s"]) == (0, [], None)
    assert unharmed(found)


@pytest.mark.parametrize(
    ("change", "whole"),
    [
        ({}, True),
        ({"done": False}, False),
        ({"home_distance": 2.5}, False),
        ({"samples_collected": 5}, False),
    ],
)
def test_only_home_with_all_samples_is_unharmed(change, whole):
    assert unharmed(result(STOP, **change)) is whole
    assert not unharmed(result(STOP, KILL, **change))


def test_each_fault_is_a_line():
    stopped = "stop bridge_node for 2.5 s: all at work after 0.4 s"
    assert fault_line(STOP).split("s  ")[1] == stopped
    assert fault_line(KILL).endswith("; lost map: 1000 known cells became 12")
    assert "the mission ended" in fault_line(LAST)


def test_each_fault_is_a_row(tmp_path):
    write_faults(tmp_path, [STOP, KILL, LAST])
    with (tmp_path / "faults.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["number"] for row in rows] == ["1", "2", "3"]
    assert (rows[0]["kind"], rows[0]["target"], rows[0]["seconds"]) == (
        "stop",
        "bridge_node",
        "2.60",
    )
    assert rows[1]["lost"] == "map: 1000 known cells became 12"
    assert (rows[2]["recovered_s"], rows[2]["lost"]) == ("", "")


@pytest.mark.parametrize(
    ("option", "bounds"), [("--minutes -1", "0 to 600"), ("--rate 0", "above 0, at most 20")]
)
def test_a_number_out_of_range_is_one_line(option, bounds, capsys):
    assert main(["chaos", *option.split()]) == 2
    assert f"is not in the range {bounds}." in capsys.readouterr().err
