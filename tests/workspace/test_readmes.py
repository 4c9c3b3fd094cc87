"""The READMEs of the packages are contracts: their tables say what the code says."""

from __future__ import annotations

import re
from dataclasses import fields
from enum import IntEnum
from pathlib import Path

import pytest
from interface_files import interface_files, members_of
from launch_files import FOLDER
from node_endpoints import PROFILES, endpoints, listed
from rclpy.node import Node
from readme_tables import ROOT, column, table

from burger_simulator.node import BurgerNode
from rover_bridge import active_client, errors, run_tracker
from rover_bridge.config import BridgeConfig
from rover_bridge.counters import Counter
from rover_bridge.node import BridgeNode
from rover_bringup import heat, mission, navigation, starts
from rover_bringup.arguments import ARGUMENTS
from rover_bringup.starts import Start
from rover_common import topics
from rover_common.input_monitor import InputLimits
from rover_common.vehicle import ROVER
from rover_decision.node import DecisionNode
from rover_navigation.node import NavigatorNode
from rover_perception.node import PerceptionNode

BRIDGE = ROOT / "rover_bridge" / "README.md"
COMMON = ROOT / "rover_common" / "README.md"
BRINGUP = ROOT / "rover_bringup" / "README.md"
INTERFACES = ROOT / "rover_interfaces" / "README.md"
# One participant of DDS has one type on a topic, and the second robot's velocities are stamped.
OF_BRIDGE = {"port": 0, "enable_stamped_cmd_vel": True}
LAUNCH_FILES = {
    "mission": mission.NAMES,
    "heat": heat.NAMES,
    "heat_controller": heat.CONTROLLER_NAMES,
    "navigation": navigation.NAMES,
}
NODES = {
    "burger": BurgerNode,
    "bridge": BridgeNode,
    "perception": PerceptionNode,
    "decision": DecisionNode,
    "navigator": NavigatorNode,
}


def words(policy: IntEnum) -> str:
    """A policy's name in words."""
    return policy.name.lower().replace("_", " ")


@pytest.mark.parametrize("heading", ["Publishes", "Subscribes"])
def test_the_bridges_topics_are_the_nodes(ros, heading):
    node = ros.add(BridgeNode, port=0)
    found = endpoints(node.publishers if heading == "Publishes" else node.subscriptions)
    assert listed(BRIDGE, heading) == found


def test_the_bridges_parameters_are_those_of_its_configuration():
    rows = table(BRIDGE, "Parameters")
    declared = [*fields(BridgeConfig), *fields(InputLimits)]
    assert [row["parameter"] for row in rows] == [field.name for field in declared]
    for row, field in zip(rows, declared, strict=True):
        info = field.metadata["parameter"]
        limits = "" if info.minimum is None else f"{info.minimum} to {info.maximum}"
        assert (row["default"], row["range"]) == (str(field.default) or "none", limits), field.name


def test_the_bridges_counters_are_those_counted():
    defects = {kind.counter for kind in errors.TelemetryError.__subclasses__()}
    rows = column(BRIDGE, "Counters", "counter")
    assert len(rows) == len(set(rows))
    assert set(rows) == {counter.value for counter in Counter} | defects


def test_the_bridges_flow_names_all_its_modules():
    flow = BRIDGE.read_text().split("## The flow of one telemetry\n")[1].split("\n## ")[0]
    modules = {path.name for path in (ROOT / "rover_bridge" / "rover_bridge").glob("*.py")}
    aside = {"__init__.py", "config.py", "counters.py"}
    assert {name for name in modules if f"`{name}`" in flow} == modules - aside


@pytest.mark.parametrize(
    ("heading", "folder", "prefix"),
    [("Modules without ROS", "", ""), ("Modules with ROS", "ros", "ros/")],
)
def test_the_common_modules_are_all_listed(heading, folder, prefix):
    files = (ROOT / "rover_common" / "rover_common" / folder).glob("*.py")
    names = {prefix + path.stem for path in files if path.stem != "__init__"}
    assert set(column(COMMON, heading, "module")) == names


def test_the_qos_profiles_are_those_of_the_code():
    rows = table(COMMON, "QoS profiles")
    assert {row["profile"] for row in rows} == set(PROFILES)
    for row in rows:
        profile = PROFILES[row["profile"]]
        assert row["reliability"] == words(profile.reliability)
        assert row["durability"] == words(profile.durability)
        assert row["depth"] == str(profile.depth)


def test_the_topics_are_those_that_the_nodes_publish(ros):
    rows = table(COMMON, "Topics")
    names = {name: value for name, value in vars(topics).items() if name.isupper()}
    assert {row["constant"]: row["topic"] for row in rows} == names
    for publisher, factory in NODES.items():
        node: Node = ros.add(factory, **(OF_BRIDGE if publisher == "bridge" else {}))
        of_readme = {
            (row["topic"].lstrip("/"), row["type"], row["QoS"])
            for row in rows
            if row["publisher"] == publisher
        }
        shared = set(names.values()) - {topics.CMD_VEL}  # of the type that the robot takes
        of_node = {endpoint for endpoint in endpoints(node.publishers) if endpoint[0] in shared}
        assert of_readme == of_node


def test_the_launch_arguments_are_those_of_the_list():
    rows = table(BRINGUP, "Launch arguments")
    assert [row["argument"] for row in rows] == list(ARGUMENTS)
    for row in rows:
        default, meaning = ARGUMENTS[row["argument"]]
        if default is not None:  # a file of the package
            assert row["default"] == (default or "")
        assert row["meaning"] == meaning
        taken = {name for name, names in LAUNCH_FILES.items() if row["argument"] in names}
        assert set(row["of"].replace("`", "").split(", ")) == taken


def test_the_launch_files_are_those_of_the_table():
    files = {file.name.removesuffix(".launch.py") for file in FOLDER.glob("*.launch.py")}
    assert files == set(LAUNCH_FILES)


def test_the_launched_nodes_are_those_of_the_plan(monkeypatch):
    monkeypatch.setattr(starts, "get_package_share_directory", lambda _: str(BRINGUP.parent))
    defaults = {name: default or "" for name, (default, _) in ARGUMENTS.items()}
    given = {name: defaults[name] for name in mission.NAMES} | {
        "sim": "true",
        "record": "true",
        "robot_model": "false",
    }
    plan = [each for each in mission.plan(given) if isinstance(each, Start)]
    rows = table(BRINGUP, "Nodes")
    assert {row["node"]: (row["package"], row["when it ends"]) for row in rows} == {
        each.executable: (each.package, each.at_end.value) for each in plan
    }


def test_the_bringup_files_are_all_listed():
    folder = BRINGUP.parent
    names = ("launch", "config", "rviz", "urdf", "foxglove")
    files = [path for name in names for path in (folder / name).iterdir()]
    names = column(BRINGUP, "Files", "file")
    assert set(names) == {str(path.relative_to(folder)) for path in files if path.is_file()}


@pytest.mark.parametrize("path", interface_files(), ids=lambda path: path.name)
def test_the_members_are_those_of_the_interface_file(path: Path):
    rows = [
        (row.get("part", ""), row["member"], row["type"], row["meaning"])
        for row in table(INTERFACES, path.name)
    ]
    members = members_of(path)
    assert rows == [(m.section, m.name, m.type, m.comment) for m in members]
    assert all(m.comment for m in members if m.name != "reason"), "a member has no comment"


def test_the_protocols_document_names_every_defect_and_the_thresholds_of_a_run():
    text = (ROOT / "docs" / "protocol.md").read_text()
    assert set(re.findall(r"`(telemetry_\w+)`", text)) == {
        kind.counter for kind in errors.TelemetryError.__subclasses__()
    }
    assert f"by more than {run_tracker.CLOCK_FELL_BACK:g} s" in text
    assert f"by more than {run_tracker.POSE_JUMPED:g} m" in text
    assert f"a speed of at most {ROVER.pickup_speed:g} m/s" in text
    assert f"owed a telemetry for {active_client.SILENCE:g} s" in text
