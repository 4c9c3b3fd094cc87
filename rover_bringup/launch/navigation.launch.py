"""Whatever serves navigate_to_pose, and only one of it: Nav2 with its SLAM, or navigator_node.

ros2 launch rover_bringup navigation.launch.py navigator:=embedded
"""

from launch import LaunchDescription

from rover_bringup import navigation
from rover_bringup.launching import description_of


def generate_launch_description() -> LaunchDescription:
    return description_of(navigation.NAMES, {}, navigation.plan)
