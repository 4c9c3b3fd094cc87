"""Variants of the robot and faults of its sensors; the node declares the same as parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_common.config import parameter

FLIPS = ("none", "rows", "columns", "both")


@dataclass(frozen=True)
class BurgerOptions:
    box_body: bool = parameter(False, "a body of 0.27 x 0.30 m with corners instead of a disc")
    scan_rate: float = parameter(
        10.0, "turns of the lidar [1/s], 5 or 10", minimum=5.0, maximum=10.0
    )
    thermal_rate: float = parameter(
        10.0, "frames of each thermal sensor [1/s], 1 or 10", minimum=1.0, maximum=10.0
    )
    thermal_delay: float = parameter(
        0.05, "from a thermal frame to its arrival [s]", minimum=0.0, maximum=1.0
    )
    thermal_yaw_1: float = parameter(
        math.radians(87.0), "of thermal sensor 1, left positive [rad]", minimum=-3.2, maximum=3.2
    )
    thermal_yaw_2: float = parameter(
        0.0, "of thermal sensor 2, left positive [rad]", minimum=-3.2, maximum=3.2
    )
    thermal_offset_1: float = parameter(
        0.0, "added to the offset drawn for sensor 1 [K]", minimum=-10.0, maximum=10.0
    )
    thermal_offset_2: float = parameter(
        0.0, "added to the offset drawn for sensor 2 [K]", minimum=-10.0, maximum=10.0
    )
    thermal_flip_1: str = parameter("none", "how sensor 1 is mirrored", choices=FLIPS)
    thermal_flip_2: str = parameter("none", "how sensor 2 is mirrored", choices=FLIPS)
    thermal_dead: int = parameter(
        0, "thermal sensor that says nothing, 0 for neither", minimum=0, maximum=2
    )
    odometry_x: float = parameter(0.0, "where odometry begins [m]", minimum=-1.0e9, maximum=1.0e9)
