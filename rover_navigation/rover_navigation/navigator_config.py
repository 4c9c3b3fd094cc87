"""Parameters of the embedded navigator."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import parameter


@dataclass(frozen=True)
class NavigatorConfig:
    resolution: float = parameter(0.05, "[m] of the map's cells", minimum=0.02, maximum=0.2)
    map_period: float = parameter(
        1.0, "[s] between two maps that are given out", minimum=0.1, maximum=60.0
    )
    plan_period: float = parameter(
        0.5, "[s] after which a path is planned again", minimum=0.1, maximum=10.0
    )
    samples: int = parameter(
        500, "trajectories that the controller tries in a step", minimum=50, maximum=10000
    )
    goal_tolerance: float = parameter(
        0.08, "[m] from a goal of the action that counts as there", minimum=0.01, maximum=1.0
    )
    yaw_tolerance: float = parameter(
        0.08, "[rad] of the heading at a goal", minimum=0.02, maximum=3.2
    )
    input_timeout: float = parameter(
        0.5, "[s] without scan or odometry after which it stops", minimum=0.1, maximum=5.0
    )
