"""The rover's mission: bridge, perception, decision, live page; on request the simulator.

ros2 launch rover_bringup mission.launch.py sim:=true seed:=3 explorer:=frontier
ros2 launch rover_bringup mission.launch.py --show-args

Ends when the bridge or the simulator ends; perception and decision are started again.
"""

from launch import LaunchDescription

from rover_bringup import mission
from rover_bringup.launching import description_of

FILES = {"params_file": "rover.yaml"}


def generate_launch_description() -> LaunchDescription:
    return description_of(mission.NAMES, FILES, mission.plan)
