"""Parameters of the sample-return mission."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import STATE_DIR, parameter
from rover_decision.missions.sample_return.explorer_names import EXPLORERS


@dataclass(frozen=True)
class DecisionConfig:
    explorer: str = parameter(
        "tour",
        "how to explore: tour, frontier, classic_a, classic_b, or one of an installed package",
        choices=EXPLORERS,
        settable=True,
    )
    way_home: str = parameter(
        "breadcrumbs",
        "how to come home: breadcrumbs, shortest_path or bearing; the others are tried when it"
        " makes no progress",
        choices=("breadcrumbs", "shortest_path", "bearing"),
        settable=True,
    )
    top_speed: float = parameter(
        3.6, "[m/s] speed on open ground", minimum=0.2, maximum=5.0, settable=True
    )
    stop_clearance: float = parameter(
        0.9,
        "[m] free ground ahead, beyond what braking takes, below which the rover stops",
        minimum=0.5,
        maximum=10.0,
    )
    go_clearance: float = parameter(
        2.5, "[m] free ground ahead above which it goes on by sight", minimum=0.5, maximum=20.0
    )
    corridor: float = parameter(
        0.5, "[m] half width of the corridor that must be free", minimum=0.4, maximum=2.0
    )
    rock_range: float = parameter(
        3.5,
        "[m] distance within which a rock is driven to by sight",
        minimum=1.0,
        maximum=30.0,
    )
    rock_deadline: float = parameter(
        30.0, "[s] after which a rock is given up for a while", minimum=5.0, maximum=600.0
    )
    retry_after: float = parameter(
        60.0, "[s] after which a rock given up is tried again", minimum=0.0, maximum=3600.0
    )
    search_limit: float = parameter(
        600.0,
        "[s] of searching known ground for samples, after which they are left",
        minimum=0.0,
        maximum=36000.0,
    )
    stuck_seconds: float = parameter(
        6.0, "[s] without progress after which the rover is stuck", minimum=1.0, maximum=60.0
    )
    tilt_limit: float = parameter(
        0.16, "[rad] pitch or roll beyond which the rover backs off", minimum=0.05, maximum=1.0
    )
    home_radius: float = parameter(
        1.5, "[m] distance to the start that counts as home", minimum=0.5, maximum=10.0
    )
    time_limit: float = parameter(
        840.0, "[s] of mission time within which to be home", minimum=10.0, maximum=36000.0
    )
    complete_at: float = parameter(
        0.0,
        "share of the map at which the mission is complete; 0 for no such share",
        minimum=0.0,
        maximum=1.0,
    )
    complete_rule: str = parameter(
        "any",
        "what completes the mission: any of all samples and the share of the map, or all of it",
        choices=("any", "all"),
    )
    truth: str = parameter(
        "", "picture of the true map that the share is of; empty: by the borders of the own map"
    )
    nav_cell: float = parameter(
        0.25,
        "[m] cell of nav_polar, as a classic counts them: 0.1 with perception's baseline",
        minimum=0.01,
        maximum=1.0,
    )
    turn_after_pickup: bool = parameter(False, "whether classic_b turns left after a pickup")
    avoid_visited: float = parameter(
        0.0,
        "how much less visited ground counts in the bearing of classic_b; 0 for not at all",
        minimum=0.0,
        maximum=1.0,
    )
    plan_delay: float = parameter(
        0.16,
        "[s] of frame time from the map that a plan is made of to the plan's effect",
        minimum=0.0,
        maximum=5.0,
    )
    plan_max_age: float = parameter(
        3.0,
        "[s] of frame time after which a plan or its map is too old to drive with; more than"
        " perception's map_period",
        minimum=0.5,
        maximum=120.0,
    )
    state_dir: str = parameter(*STATE_DIR)
