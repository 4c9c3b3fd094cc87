"""The heat mission: navigator, mission, live page; on request the simulator.

ros2 launch rover_bringup heat.launch.py sim:=true seed:=7
ros2 launch rover_bringup heat.launch.py --show-args

Ends when the simulator ends; mission and navigator_node are started again.
"""

from launch import LaunchDescription

from rover_bringup import heat
from rover_bringup.launching import description_of

FILES = {"params_file": "heat.yaml", "sim_params_file": "burger.yaml"}


def generate_launch_description() -> LaunchDescription:
    return description_of(heat.NAMES, FILES, heat.plan)
