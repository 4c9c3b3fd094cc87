"""The three nodes of the mission, its live page, and its recording and RViz on request.

ros2 launch rover_bringup mission.launch.py [params_file:=FILE] [use_sim_time:=true]
    [namespace:=NAME] [log_level:=info] [dashboard:=false] [record:=true]
    [use_rviz:=true] [host:=127.0.0.1] [port:=4567]

A node that ends is started again after RESPAWN_DELAY; Ctrl-C ends all of them.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

ARGUMENTS = {
    "params_file": (None, "parameters of all nodes"),
    "use_sim_time": ("false", "take the time from /clock, as the embedded simulator sends it"),
    "namespace": ("", "namespace of the nodes and their topics"),
    "log_level": ("info", "debug, info, warn or error"),
    "dashboard": ("true", "serve the live page"),
    "record": ("false", "record all topics"),
    "use_rviz": ("false", "start RViz with the rover's view"),
    "host": ("127.0.0.1", "address that the bridge listens on"),
    "port": ("4567", "TCP port that the bridge listens on"),
}
RESPAWN_DELAY = 1.0  # [s] for the port of a bridge that died to become free
NODES = {
    "rover_bridge": "bridge_node",
    "rover_perception": "perception_node",
    "rover_decision": "decision_node",
}


def generate_launch_description() -> LaunchDescription:
    share = FindPackageShare("rover_bringup")
    defaults = {name: default for name, (default, _) in ARGUMENTS.items()}
    defaults["params_file"] = PathJoinSubstitution([share, "config", "rover.yaml"])
    arguments = [
        DeclareLaunchArgument(name, default_value=defaults[name], description=description)
        for name, (_, description) in ARGUMENTS.items()
    ]
    use_sim_time = ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool)
    address = {
        "host": ParameterValue(LaunchConfiguration("host"), value_type=str),
        "port": ParameterValue(LaunchConfiguration("port"), value_type=int),
    }
    nodes = [
        Node(
            package=package,
            executable=executable,
            name=executable,
            namespace=LaunchConfiguration("namespace"),
            output="screen",
            respawn=True,
            respawn_delay=RESPAWN_DELAY,
            parameters=[
                LaunchConfiguration("params_file"),
                {"use_sim_time": use_sim_time},
                address if package == "rover_bridge" else {},
            ],
            arguments=["--ros-args", "--log-level", LaunchConfiguration("log_level")],
        )
        for package, executable in NODES.items()
    ]
    return LaunchDescription([*arguments, *nodes, *optional_nodes(share)])


def optional_node(argument: str, owner: str, executable: str) -> Node:
    """A node beside the mission, if the launch argument is true."""
    return Node(
        package=owner,
        executable=executable,
        name=executable,
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        parameters=[LaunchConfiguration("params_file")],
        condition=IfCondition(LaunchConfiguration(argument)),
    )


def optional_nodes(share: FindPackageShare) -> list[Node]:
    """What shows and records the mission, each on request."""
    dashboard = optional_node("dashboard", "rover_dashboard", "dashboard_node")
    recorder = optional_node("record", "rover_recorder", "recorder_node")
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        arguments=["-d", PathJoinSubstitution([share, "rviz", "rover.rviz"])],
        condition=IfCondition(LaunchConfiguration("use_rviz")),
    )
    return [dashboard, recorder, rviz]
