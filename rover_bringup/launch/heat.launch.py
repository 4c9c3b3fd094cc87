"""The heat mission's whole graph: navigator, mission, and on request simulator, page and RViz.

ros2 launch rover_bringup heat.launch.py [params_file:=FILE] [use_sim_time:=true]
    [namespace:=NAME] [log_level:=info] [dashboard:=false] [record:=true] [use_rviz:=true]
    [navigator:=auto] [slam:=false map:=FILE] [navigation_params_file:=FILE]
    [slam_params_file:=FILE] [use_sim:=true] [sim_params_file:=FILE]

Mission and navigator are started again when they end; Ctrl-C ends all.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, OrSubstitution, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

ARGUMENTS = {
    "params_file": (None, "parameters of heat_node"),
    "use_sim_time": ("false", "take the time from /clock"),
    "namespace": ("", "namespace of the nodes and their topics"),
    "log_level": ("info", "debug, info, warn or error"),
    "dashboard": ("true", "serve the live page"),
    "record": ("false", "record all topics"),
    "use_rviz": ("false", "start RViz with the heat mission's view"),
    "navigator": ("auto", "nav2, embedded, or auto (nav2 where it is installed)"),
    "slam": ("true", "make the map; false takes the file that map names, which nav2 can"),
    "map": ("", "YAML file of a known map, for slam:=false"),
    "navigation_params_file": ("", "parameters of Nav2, by default those of TURTLEBOT3_MODEL"),
    "slam_params_file": ("", "parameters of slam_toolbox"),
    "use_sim": ("false", "start burger_node in place of a robot; /clock is its time"),
    "sim_params_file": (None, "parameters of burger_node"),
}
FILES = {"params_file": "heat.yaml", "sim_params_file": "burger.yaml"}
# What the launch files of navigator and mission are told.
INCLUDED = {
    "navigation": ("navigator", "slam", "map", "slam_params_file", "namespace", "log_level"),
    "heat_controller": ("params_file", "namespace", "log_level"),
}


def generate_launch_description() -> LaunchDescription:
    share = FindPackageShare("rover_bringup")
    defaults = {name: default for name, (default, _) in ARGUMENTS.items()}
    for name, file in FILES.items():
        defaults[name] = PathJoinSubstitution([share, "config", file])
    arguments = [
        DeclareLaunchArgument(name, default_value=defaults[name], description=description)
        for name, (_, description) in ARGUMENTS.items()
    ]
    included = [included_file(share, name, passed) for name, passed in INCLUDED.items()]
    return LaunchDescription([*arguments, simulator(), *included, *optional_nodes(share)])


def included_file(share: FindPackageShare, name: str, passed: tuple[str, ...]) -> GroupAction:
    """In a scope of its own: both files have arguments of the same name."""
    settings = {each: LaunchConfiguration(each) for each in passed}
    settings["use_sim_time"] = OrSubstitution(
        LaunchConfiguration("use_sim_time"), LaunchConfiguration("use_sim")
    )
    if name == "navigation":
        settings["params_file"] = LaunchConfiguration("navigation_params_file")
    file = PathJoinSubstitution([share, "launch", f"{name}.launch.py"])
    return GroupAction([IncludeLaunchDescription(file, launch_arguments=list(settings.items()))])


def simulator() -> Node:
    """It makes /clock and does not follow it."""
    return Node(
        package="burger_simulator",
        executable="burger_node",
        name="burger_node",
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        parameters=[LaunchConfiguration("sim_params_file")],
        arguments=["--ros-args", "--log-level", LaunchConfiguration("log_level")],
        condition=IfCondition(LaunchConfiguration("use_sim")),
    )


def optional_nodes(share: FindPackageShare) -> list[Node]:
    """What shows and records the mission, each on request."""
    shared = PathJoinSubstitution([share, "config", "rover.yaml"])
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", PathJoinSubstitution([share, "rviz", "heat.rviz"])],
        condition=IfCondition(LaunchConfiguration("use_rviz")),
    )
    return [
        optional_node("dashboard", "rover_dashboard", "dashboard_node", [shared]),
        optional_node("record", "rover_recorder", "recorder_node", [shared, {"mission": "heat"}]),
        rviz,
    ]


def optional_node(argument: str, owner: str, executable: str, parameters: list[object]) -> Node:
    """A node beside the mission, if the launch argument is true."""
    return Node(
        package=owner,
        executable=executable,
        name=executable,
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        parameters=parameters,
        condition=IfCondition(LaunchConfiguration(argument)),
    )
