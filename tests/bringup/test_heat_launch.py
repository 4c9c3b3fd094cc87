"""The heat mission's launch files, and what ships for Nav2, slam_toolbox and RViz."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import rclpy
import yaml
from rclpy.context import Context
from rclpy.node import Node
from readme_tables import ROOT

from rover_bringup import navigation, starts
from rover_bringup.arguments import ARGUMENTS
from rover_bringup.starts import LaunchError, Start
from rover_common import frames, topics
from rover_common.burger import BURGER
from rover_heat.config import HeatConfig
from rover_navigation.navigator_config import NavigatorConfig

CONFIG = ROOT / "rover_bringup" / "config"
NAV2 = CONFIG / "nav2_burger.yaml"
LANE = 0.61  # [m]
COSTMAPS = ("global_costmap", "local_costmap")


@pytest.fixture
def parameters_of(domain_id):
    """What ROS reads out of a file for a node of a name."""
    context = Context()
    rclpy.init(context=context, args=[], domain_id=domain_id)
    nodes = []

    def read(file: Path, name: str, namespace: str = "") -> dict[str, Any]:
        node = Node(
            name,
            namespace=namespace,
            context=context,
            cli_args=["--ros-args", "--params-file", str(file)],
            automatically_declare_parameters_from_overrides=True,
        )
        nodes.append(node)
        return {key: each.value for key, each in node.get_parameters_by_prefix("").items()}

    yield read
    for node in nodes:
        node.destroy_node()
    context.try_shutdown()


@pytest.mark.parametrize("costmap", COSTMAPS)
def test_the_costmaps_of_nav2_have_the_robots_size_and_the_blocked_places(parameters_of, costmap):
    found = parameters_of(NAV2, costmap, costmap)  # Nav2 gives each a namespace of its own
    assert found["robot_radius"] == BURGER.body_radius
    assert found["resolution"] == NavigatorConfig.resolution
    assert found["plugins"] == ["static_layer", "obstacle_layer", "inflation_layer"]
    assert found["static_layer.map_topic"] == f"/{topics.HAZARD_MAP}"
    assert found["static_layer.map_subscribe_transient_local"] is True
    assert found["obstacle_layer.scan.topic"] == f"/{topics.SCAN}"
    assert BURGER.body_radius < found["inflation_layer.inflation_radius"] < LANE / 2
    assert found["robot_base_frame"] == frames.BASE_FOOTPRINT


def test_the_planner_and_the_controller_of_nav2_are_navfn_with_a_star_and_mppi(parameters_of):
    planner = parameters_of(NAV2, "planner_server")
    assert planner["GridBased.plugin"] == "nav2_navfn_planner::NavfnPlanner"
    assert planner["GridBased.use_astar"] is True
    controller = parameters_of(NAV2, "controller_server")
    assert controller["FollowPath.plugin"] == "nav2_mppi_controller::MPPIController"
    assert controller["FollowPath.vx_max"] == BURGER.cruise_speed
    assert controller["FollowPath.wz_max"] == BURGER.cruise_turn
    assert controller["goal_checker.xy_goal_tolerance"] < HeatConfig.stand_off_tolerance
    navigator = parameters_of(NAV2, "bt_navigator")
    assert navigator["navigators"] == [topics.NAVIGATE]


def test_both_that_drive_send_the_same_type_of_velocity(parameters_of):
    drivers = [parameters_of(NAV2, name) for name in ("controller_server", "behavior_server")]
    stamped = parameters_of(CONFIG / "burger.yaml", "burger_node")["stamped_cmd_vel"]
    assert [each["enable_stamped_cmd_vel"] for each in drivers] == [stamped, stamped]


def test_slam_toolbox_makes_the_map_that_the_mission_reads(parameters_of):
    found = parameters_of(CONFIG / "slam_toolbox.yaml", "slam_toolbox")
    assert (found["map_frame"], found["odom_frame"]) == (frames.MAP, frames.ODOM)
    assert found["base_frame"] == frames.BASE_FOOTPRINT
    assert found["resolution"] == NavigatorConfig.resolution
    assert found["max_laser_range"] == BURGER.lidar_range_max
    assert found["map_update_interval"] <= 1.0 / HeatConfig.control_rate


def test_the_view_shows_topics_of_the_mission():
    view = yaml.safe_load((ROOT / "rover_bringup" / "rviz" / "heat.rviz").read_text())
    displays = view["Visualization Manager"]["Displays"]
    shown = {each["Topic"]["Value"].lstrip("/") for each in displays if "Topic" in each}
    names = {value for name, value in vars(topics).items() if name.isupper()}
    assert shown - {"global_costmap/costmap"} <= names
    wanted = {topics.MAP, topics.HAZARD_MAP, topics.SCAN, topics.PLAN, topics.HEAT_MARKERS}
    assert shown >= wanted
    assert view["Visualization Manager"]["Global Options"]["Fixed Frame"] == frames.MAP


def started(monkeypatch, nav2: bool, **values: str) -> list[str]:
    """The executables, and the files of what is included; `nav2`: it is installed."""
    here = str(ROOT / "rover_bringup")
    monkeypatch.setattr(navigation, "is_installed", lambda _: nav2)
    monkeypatch.setattr(starts, "get_package_share_directory", lambda _: here)
    monkeypatch.setattr(navigation, "get_package_share_directory", lambda _: here)
    defaults = {name: ARGUMENTS[name][0] or "" for name in navigation.NAMES}
    plan = navigation.plan(defaults | values)
    return [each.executable if isinstance(each, Start) else Path(each.file).stem for each in plan]


SERVERS = [
    "controller_server", "planner_server", "behavior_server", "bt_navigator", "lifecycle_manager",
]  # fmt: skip
SLAM, KNOWN = ["online_async_launch"], ["map_server", "amcl", "lifecycle_manager"]


@pytest.mark.parametrize(
    ("nav2", "values", "expected"),
    [
        (False, {}, ["navigator_node"]),
        (True, {}, SERVERS + SLAM),
        (True, {"navigator": "embedded"}, ["navigator_node"]),
        (True, {"navigator": "nav2"}, SERVERS + SLAM),
        (True, {"slam": "false", "map": "maze.yaml"}, SERVERS + KNOWN),
    ],
)
def test_exactly_one_navigator_is_started(monkeypatch, nav2, values, expected):
    monkeypatch.delenv("TURTLEBOT3_MODEL", raising=False)
    assert started(monkeypatch, nav2, **values) == expected


@pytest.mark.parametrize(
    ("nav2", "values", "error"),
    [
        (False, {"navigator": "nav2"}, "needs nav2_controller"),
        (False, {"slam": "false", "map": "maze.yaml"}, "makes its own map"),
        (True, {"slam": "false"}, "map:=FILE"),
        (True, {"navigator": "nav3"}, "none of auto, nav2, embedded"),
    ],
)
def test_what_no_navigator_can_do_is_an_error(monkeypatch, nav2, values, error):
    with pytest.raises(LaunchError, match=error):
        started(monkeypatch, nav2, **values)


def test_the_parameters_of_nav2_are_those_of_the_robots_model(monkeypatch):
    monkeypatch.setattr(navigation, "shipped", lambda folder, name: str(CONFIG / name))
    given = {"navigation_params_file": ""}
    monkeypatch.delenv("TURTLEBOT3_MODEL", raising=False)
    assert navigation.nav2_parameters(given) == str(NAV2)
    monkeypatch.setenv("TURTLEBOT3_MODEL", "waffle")
    with pytest.raises(LaunchError, match="TURTLEBOT3_MODEL=waffle"):
        navigation.nav2_parameters(given)
    assert navigation.nav2_parameters({"navigation_params_file": str(NAV2)}) == str(NAV2)
