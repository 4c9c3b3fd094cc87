"""Parameters of the decision node; distances, speeds and times have their sources in comments."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import parameter


@dataclass(frozen=True)
class DecisionConfig:
    explorer: str = parameter(
        "wall_follow_b",
        "how to explore: wall_follow_a or wall_follow_b",
        choices=("wall_follow_a", "wall_follow_b"),
    )
    top_speed: float = parameter(2.0, "[m/s] speed on open ground", minimum=0.2, maximum=5.0)
    stop_clearance: float = parameter(
        1.2, "[m] free way ahead below which the rover stops", minimum=0.5, maximum=10.0
    )
    go_clearance: float = parameter(
        2.5, "[m] free way ahead above which it goes on", minimum=0.5, maximum=20.0
    )
    corridor: float = parameter(
        0.55, "[m] half width of the way that must be free", minimum=0.4, maximum=2.0
    )
    rock_range: float = parameter(
        8.0, "[m] distance within which a rock is approached", minimum=1.0, maximum=30.0
    )
    rock_deadline: float = parameter(
        40.0, "[s] after which a rock is given up for a while", minimum=5.0, maximum=600.0
    )
    retry_after: float = parameter(
        90.0, "[s] after which a rock given up is tried again", minimum=0.0, maximum=3600.0
    )
    stuck_seconds: float = parameter(
        6.0, "[s] without progress after which the rover is stuck", minimum=1.0, maximum=60.0
    )
    tilt_limit: float = parameter(
        0.16, "[rad] pitch or roll beyond which the rover backs off", minimum=0.05, maximum=1.0
    )
    home_radius: float = parameter(
        2.0, "[m] distance to the start that counts as home", minimum=0.5, maximum=10.0
    )
    explore_limit: float = parameter(
        600.0, "[s] of exploring after which the rover goes home", minimum=10.0, maximum=36000.0
    )
