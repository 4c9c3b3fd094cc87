"""The heat mission's node: states, goals, launches, ramp.

ros2 launch rover_bringup heat_controller.launch.py [params_file:=FILE] [use_sim_time:=true]
    [namespace:=NAME] [log_level:=info]
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

ARGUMENTS = {
    "params_file": (None, "parameters of heat_node"),
    "use_sim_time": ("false", "take the time from /clock"),
    "namespace": ("", "namespace of the node and its topics"),
    "log_level": ("info", "debug, info, warn or error"),
}
RESPAWN_DELAY = 1.0  # [s]


def generate_launch_description() -> LaunchDescription:
    share = FindPackageShare("rover_bringup")
    defaults = {name: default for name, (default, _) in ARGUMENTS.items()}
    defaults["params_file"] = PathJoinSubstitution([share, "config", "heat.yaml"])
    arguments = [
        DeclareLaunchArgument(name, default_value=defaults[name], description=description)
        for name, (_, description) in ARGUMENTS.items()
    ]
    use_sim_time = ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool)
    mission = Node(
        package="rover_heat",
        executable="heat_node",
        name="heat_node",
        namespace=LaunchConfiguration("namespace"),
        output="screen",
        respawn=True,
        respawn_delay=RESPAWN_DELAY,
        parameters=[LaunchConfiguration("params_file"), {"use_sim_time": use_sim_time}],
        arguments=["--ros-args", "--log-level", LaunchConfiguration("log_level")],
    )
    return LaunchDescription([*arguments, mission])
