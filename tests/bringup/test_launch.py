"""What the launch files start: as plans, which need no launch, and as launch reads them."""

from __future__ import annotations

import importlib.util
from typing import Any

import pytest
from launch_files import FOLDER
from readme_tables import ROOT

from rover_bringup import heat, mission, navigation, starts
from rover_bringup.arguments import ARGUMENTS, problem_of
from rover_bringup.starts import AtEnd, LaunchError, Start, ends_all, remappings_of
from rover_common.errors import CANNOT_START

CONFIG = ROOT / "rover_bringup" / "config"
FILES = {
    "params_file": str(CONFIG / "rover.yaml"),
    "sim_params_file": str(CONFIG / "burger.yaml"),
}
NODES = {"rover_bridge", "rover_perception", "rover_decision"}


@pytest.fixture(autouse=True)
def installed(monkeypatch) -> set[str]:
    """The packages that there are; the test adds some."""
    there: set[str] = set()
    for module in (starts, mission, navigation):
        monkeypatch.setattr(module, "is_installed", lambda package: package in there)
    here = ROOT / "rover_bringup"
    monkeypatch.setattr(starts, "get_package_share_directory", lambda _: str(here))
    return there


def given(names: tuple[str, ...], **values: str) -> dict[str, str]:
    """The defaults, and these values over them."""
    return {name: FILES.get(name, ARGUMENTS[name][0] or "") for name in names} | values


def planned(module: Any, **values: str) -> dict[str, Start]:
    """What is started, by its executable."""
    return {each.executable: each for each in module.plan(given(module.NAMES, **values))}


def test_one_command_starts_a_rover_that_drives():
    plan = planned(mission, sim="true", seed="3", explorer="frontier", sim_rate="2", sim_size="0.5",
                   port="5000")  # fmt: skip
    assert {each.package for each in plan.values()} == NODES | {
        "rover_simulator",
        "rover_dashboard",
    }
    assert plan["simulator_node"].values == {"seed": 3, "rate": 2.0, "size": 0.5, "port": 5000}
    assert plan["decision_node"].values == {"use_sim_time": True, "explorer": "frontier"}
    assert plan["bridge_node"].values["port"] == 5000


def test_what_is_not_given_is_left_to_the_file():
    plan = planned(mission)
    assert "simulator_node" not in plan
    for node in ("bridge_node", "perception_node", "decision_node"):
        assert plan[node].values == {"use_sim_time": False}
        assert plan[node].files == (FILES["params_file"],)
    assert plan["dashboard_node"].values == {}


def test_all_ends_with_the_bridge_and_the_simulator_and_what_thinks_is_started_again():
    plan = planned(mission, sim="true")
    ends = {name: each.at_end for name, each in plan.items()}
    assert ends["bridge_node"] is ends["simulator_node"] is AtEnd.SHUTDOWN
    assert ends["perception_node"] is ends["decision_node"] is AtEnd.RESPAWN
    assert planned(heat, sim="true")["burger_node"].at_end is AtEnd.SHUTDOWN
    assert planned(heat)["heat_node"].at_end is AtEnd.RESPAWN


def test_a_node_that_refuses_its_parameters_ends_the_launch_and_one_that_crashed_does_not():
    assert ends_all(AtEnd.RESPAWN, CANNOT_START)
    assert not ends_all(AtEnd.RESPAWN, 1)
    assert not ends_all(AtEnd.RESPAWN, -9)
    assert not ends_all(AtEnd.NOTHING, CANNOT_START)
    assert ends_all(AtEnd.SHUTDOWN, 0)


def test_the_heat_mission_drives_a_simulator_or_a_robot():
    with_simulator = planned(heat, sim="true", seed="7", record="true")
    assert with_simulator["burger_node"].values == {"seed": 7}
    assert with_simulator["navigator_node"].values == {"use_sim_time": True}
    assert with_simulator["recorder_node"].values == {"mission": "heat"}
    assert "burger_node" not in planned(heat)


def test_a_namespace_has_its_own_transforms_clock_and_diagnostics():
    names = mission.NAMES
    assert remappings_of(given(names)) == remappings_of(given(names, namespace="/")) == ()
    assert dict(remappings_of(given(names, namespace="one"))) == {
        "/tf": "tf", "/tf_static": "tf_static", "/clock": "clock", "/diagnostics": "diagnostics",
    }  # fmt: skip


def test_a_frame_prefix_reaches_every_node_that_names_frames(installed):
    installed.add("rviz2")
    plan = planned(mission, frame_prefix="one/", use_rviz="true")
    for node in ("bridge_node", "perception_node", "decision_node"):
        assert plan[node].values["frame_prefix"] == "one/"
    assert plan["rviz2"].arguments[-2:] == ("-f", "one/map")
    of_heat = planned(heat, frame_prefix="one/", sim="true")
    assert {node for node, each in of_heat.items() if "frame_prefix" in each.values} == {
        "burger_node", "navigator_node", "heat_node",
    }  # fmt: skip


def test_the_robot_model_is_published_where_that_can_be(installed):
    assert "robot_state_publisher" not in planned(mission)
    installed.add("robot_state_publisher")
    plan = planned(mission)
    assert "base_link" in plan["robot_state_publisher"].values["robot_description"]
    assert plan["bridge_node"].values["camera_transforms"] is False
    assert "robot_state_publisher" not in planned(mission, robot_model="false")


@pytest.mark.parametrize(
    ("module", "values", "reason"),
    [
        (mission, {"params_file": "/none.yaml"}, "params_file:=/none.yaml is no file"),
        (mission, {"use_rviz": "true"}, "needs the package rviz2"),
        (mission, {"robot_model": "true"}, "needs the package robot_state_publisher"),
        (mission, {"sim": "perhaps"}, "sim:=perhaps is neither true nor false"),
        (mission, {"seed": "three"}, "seed:=three is no whole number"),
        (mission, {"seed": "-3"}, "seed:=-3 is no whole number from 0"),
        (mission, {"port": "65536"}, "port:=65536 is no whole number from 0 to 65535"),
        (mission, {"sim_rate": "fast"}, "sim_rate:=fast is no number"),
        (mission, {"sim_size": "nan"}, "sim_size:=nan is no number"),
        (mission, {"log_level": "loud"}, "log_level:=loud is none of debug"),
        (heat, {"sim_params_file": "/none.yaml", "sim": "true"}, "is no file"),
        (heat, {"use_rviz": "true"}, "needs the package rviz2"),
        (heat, {"navigator": "nav3"}, "none of auto, nav2, embedded"),
    ],
)
def test_what_cannot_be_started_is_one_line_before_anything_is(module, values, reason):
    with pytest.raises(LaunchError, match=reason.replace("?", r"\?")) as caught:
        planned(module, **values)
    assert "\n" not in str(caught.value)


def test_the_defaults_can_be_used():
    assert problem_of({name: default or "" for name, (default, _) in ARGUMENTS.items()}) == ""


@pytest.mark.parametrize("file", sorted(FOLDER.glob("*.launch.py")), ids=lambda file: file.name)
def test_launch_reads_each_file(file):
    pytest.importorskip("launch_ros", reason="launch is not installed")
    spec = importlib.util.spec_from_file_location("launch_file", file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    entities = module.generate_launch_description().entities
    assert {each.name for each in entities if hasattr(each, "name")} <= set(ARGUMENTS)
