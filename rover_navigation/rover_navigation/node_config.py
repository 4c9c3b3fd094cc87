"""Parameters of navigator_node: the navigator's own, and how it is connected."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import STATE_DIR, parameter
from rover_navigation.navigator_config import NavigatorConfig

SWITCH = ("auto", "true", "false")


@dataclass(frozen=True)
class NavigatorNodeConfig(NavigatorConfig):
    seed: int = parameter(
        0, "of the trajectories that the controller tries", minimum=0, maximum=2**31 - 1
    )
    stamped_cmd_vel: str = parameter(
        "auto",
        "whether cmd_vel is TwistStamped: true, false, or auto (as its subscriber has it)",
        choices=SWITCH,
    )
    odometry_transform: str = parameter(
        "auto",
        "whether to send odom -> base_footprint: true, false, or auto (where the robot does not)",
        choices=SWITCH,
    )
    state_dir: str = parameter(*STATE_DIR)
    lockstep: bool = parameter(
        False, "step with every sensor_tick instead of 20 times a second, and answer on it"
    )
