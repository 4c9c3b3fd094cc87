"""Whatever serves navigate_to_pose, and only one of it: Nav2 with its SLAM, or navigator_node.

Of Nav2 those servers are started that drive to a pose; each but bt_navigator is only its helper.
"""

from __future__ import annotations

import os
from pathlib import Path

from ament_index_python.packages import get_package_share_directory

from rover_bringup.arguments import Given, is_true
from rover_bringup.starts import (
    AtEnd,
    Include,
    LaunchError,
    Plan,
    Start,
    check,
    is_installed,
    shared_values,
    shipped,
)

NAMES = (
    "navigator", "slam", "map", "navigation_params_file", "slam_params_file", "use_sim_time",
    "namespace", "frame_prefix", "log_level",
)  # fmt: skip
NAVIGATION = {
    "nav2_controller": "controller_server",
    "nav2_planner": "planner_server",
    "nav2_behaviors": "behavior_server",
    "nav2_bt_navigator": "bt_navigator",
}
LOCALIZATION = {"nav2_map_server": "map_server", "nav2_amcl": "amcl"}
ABSOLUTE = ("scan", "hazard_map")  # topics that a costmap's own namespace must not change


def plan(given: Given) -> Plan:
    """The server that was asked for; raises LaunchError for what it cannot do."""
    check(given)
    navigator = given["navigator"].lower()
    missing = [package for package in NAVIGATION if not is_installed(package)]
    if navigator == "nav2" and missing:
        raise LaunchError(f"navigator:=nav2 needs {', '.join(missing)}")
    known_map = not is_true(given["slam"])
    if navigator == "embedded" or missing:
        if known_map:
            raise LaunchError("slam:=false needs Nav2: the embedded navigator makes its own map")
        return [embedded(given)]
    if known_map and not given["map"]:
        raise LaunchError("slam:=false needs map:=FILE")
    return [*nav2(given, NAVIGATION, "navigation"), *localization(given, known_map)]


def embedded(given: Given) -> Start:
    """navigator_node, which makes map and pose itself."""
    files = (shipped("config", "navigator.yaml"),)
    shared = shared_values(given)
    return Start("rover_navigation", "navigator_node", AtEnd.RESPAWN, files, shared)


def nav2(given: Given, servers: dict[str, str], name: str, **values: str) -> list[Start]:
    """Some of its servers, with values over those of the file, and the manager of their states."""
    in_time = {"use_sim_time": shared_values(given)["use_sim_time"]}
    manager = f"lifecycle_manager_{name}"
    settings = {"autostart": True, "node_names": list(servers.values()), **in_time}
    root = f"/{given['namespace'].strip('/')}" if given["namespace"].strip("/") else ""
    apart = tuple((f"/{topic}", f"{root}/{topic}") for topic in ABSOLUTE) if root else ()
    files = (nav2_parameters(given),)
    # A name would be that of all nodes in its process, where two servers have a costmap.
    return [
        *(
            Start(package, executable, files=files, values={**values, **in_time}, name="-",
                  remappings=apart)
            for package, executable in servers.items()
        ),
        Start("nav2_lifecycle_manager", "lifecycle_manager", values=settings, name=manager),
    ]  # fmt: skip


def nav2_parameters(given: Given) -> str:
    """The file that was given, else the one of the robot's model."""
    model = os.environ.get("TURTLEBOT3_MODEL", "burger")
    file = given["navigation_params_file"] or shipped("config", f"nav2_{model}.yaml")
    if not Path(file).is_file():
        raise LaunchError(f"no parameters of Nav2 for TURTLEBOT3_MODEL={model}: {file}")
    return file


def localization(given: Given, known_map: bool) -> Plan:
    """Who makes map and pose for Nav2: slam_toolbox as its own launch file starts it, or AMCL."""
    if known_map:
        return [*nav2(given, LOCALIZATION, "localization", yaml_filename=given["map"])]
    folder = Path(get_package_share_directory("slam_toolbox")) / "launch"
    settings = {
        "slam_params_file": given["slam_params_file"] or shipped("config", "slam_toolbox.yaml"),
        "use_sim_time": str(shared_values(given)["use_sim_time"]).lower(),
    }
    return [Include(str(folder / "online_async_launch.py"), settings)]
