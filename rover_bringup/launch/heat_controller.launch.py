"""The heat mission's node alone: states, goals, launches, ramp.

ros2 launch rover_bringup heat_controller.launch.py params_file:=FILE
"""

from launch import LaunchDescription

from rover_bringup import heat
from rover_bringup.launching import description_of

FILES = {"params_file": "heat.yaml"}


def generate_launch_description() -> LaunchDescription:
    return description_of(heat.CONTROLLER_NAMES, FILES, heat.controller)
