"""Whatever serves navigate_to_pose, and only one of it: Nav2 with its SLAM, or navigator_node.

ros2 launch rover_bringup navigation.launch.py [navigator:=auto] [slam:=false map:=FILE]
    [params_file:=FILE] [slam_params_file:=FILE] [use_sim_time:=true] [namespace:=NAME]
    [log_level:=info]

Of Nav2 those servers are started that drive to a pose; each but bt_navigator is only its helper.
"""

import os
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    "navigator": ("auto", "nav2, embedded, or auto (nav2 where it is installed)"),
    "slam": ("true", "make the map; false takes the file that map names, which nav2 can"),
    "map": ("", "YAML file of a known map, for slam:=false"),
    "params_file": ("", "parameters of Nav2, by default those of TURTLEBOT3_MODEL (burger)"),
    "slam_params_file": ("", "parameters of slam_toolbox"),
    "use_sim_time": ("false", "take the time from /clock"),
    "namespace": ("", "namespace of the nodes and their topics"),
    "log_level": ("info", "debug, info, warn or error"),
}
RESPAWN_DELAY = 1.0  # [s]
NAVIGATION = {
    "nav2_controller": "controller_server",
    "nav2_planner": "planner_server",
    "nav2_behaviors": "behavior_server",
    "nav2_bt_navigator": "bt_navigator",
}
LOCALIZATION = {"nav2_map_server": "map_server", "nav2_amcl": "amcl"}
ABSOLUTE = ("scan", "hazard_map")  # topics that a costmap's own namespace must not change


def generate_launch_description() -> LaunchDescription:
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, (default, description) in ARGUMENTS.items()
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=start_navigator)])


def start_navigator(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    """The server that was asked for. Raises RuntimeError for what it cannot do."""
    given = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    navigator = given["navigator"]
    if navigator not in ("auto", "nav2", "embedded"):
        raise RuntimeError(f"navigator:={navigator} is none of auto, nav2, embedded")
    missing = [package for package in NAVIGATION if not is_installed(package)]
    if navigator == "nav2" and missing:
        raise RuntimeError(f"navigator:=nav2 needs {', '.join(missing)}")
    known_map = given["slam"].lower() == "false"
    if navigator == "embedded" or missing:
        if known_map:
            raise RuntimeError("slam:=false needs Nav2: the embedded navigator makes its own map")
        return [embedded(given)]
    if known_map and not given["map"]:
        raise RuntimeError("slam:=false needs map:=FILE")
    return [*nav2(given, NAVIGATION, "navigation"), *localization(given, known_map)]


def is_installed(package: str) -> bool:
    try:
        get_package_share_directory(package)
    except PackageNotFoundError:
        return False
    return True


def file_of(name: str) -> str:
    return str(Path(get_package_share_directory("rover_bringup")) / "config" / name)


def embedded(given: dict[str, str]) -> Node:
    """navigator_node, which makes map and pose itself."""
    return node("rover_navigation", "navigator_node", given, [file_of("navigator.yaml")], True)


def nav2(given: dict[str, str], servers: dict[str, str], name: str, **values: str) -> list[Node]:
    """Some of its servers, with values over those of the file, and the manager of their states."""
    files = [nav2_parameters(given), *([values] if values else [])]
    manager = f"lifecycle_manager_{name}"
    settings = {"autostart": True, "node_names": list(servers.values())}
    return [
        *(node(package, executable, given, files) for package, executable in servers.items()),
        node("nav2_lifecycle_manager", "lifecycle_manager", given, [settings], name=manager),
    ]


def nav2_parameters(given: dict[str, str]) -> str:
    """The file that was given, else the one of the robot's model."""
    model = os.environ.get("TURTLEBOT3_MODEL", "burger")
    file = given["params_file"] or file_of(f"nav2_{model}.yaml")
    if not Path(file).is_file():
        raise RuntimeError(f"no parameters of Nav2 for TURTLEBOT3_MODEL={model}: {file}")
    return file


def localization(given: dict[str, str], known_map: bool) -> list[LaunchDescriptionEntity]:
    """Who makes map and pose for Nav2: slam_toolbox as its own launch file starts it, or AMCL."""
    if known_map:
        return [*nav2(given, LOCALIZATION, "localization", yaml_filename=given["map"])]
    folder = Path(get_package_share_directory("slam_toolbox")) / "launch"
    settings = {
        "slam_params_file": given["slam_params_file"] or file_of("slam_toolbox.yaml"),
        "use_sim_time": given["use_sim_time"],
    }
    source = str(folder / "online_async_launch.py")
    return [IncludeLaunchDescription(source, launch_arguments=list(settings.items()))]


def node(
    package: str,
    executable: str,
    given: dict[str, str],
    parameters: list[object],
    respawn: bool = False,
    name: str = "",
) -> Node:
    """A node of this namespace, clock and log level.

    A name would be that of all nodes in its process, where two of Nav2's servers have a costmap.
    """
    root = f"/{given['namespace']}" if given["namespace"].strip("/") else ""
    sim_time = {"use_sim_time": given["use_sim_time"].lower() == "true"}
    return Node(
        package=package,
        executable=executable,
        name=name or None,
        namespace=given["namespace"],
        output="screen",
        respawn=respawn,
        respawn_delay=RESPAWN_DELAY,
        parameters=[*parameters, sim_time],
        remappings=[(f"/{topic}", f"{root}/{topic}") for topic in ABSOLUTE] if root else [],
        arguments=["--ros-args", "--log-level", given["log_level"]],
    )
