"""Parameters of the heat mission; each is declared here and nowhere else."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import parameter

FLIPS = ("none", "rows", "columns", "both")


@dataclass(frozen=True)
class HeatConfig:
    angle_heat_scan: float = parameter(
        0.1222,
        "[rad] half the lidar window around a thermal sensor's axis, when heat_bearing is axis",
        minimum=0.0174,
        maximum=0.524,
    )
    heat_bearing: str = parameter(
        "pixels",
        "where the lidar window lies: pixels (around the warm pixels) or axis (the sensor's)",
        choices=("pixels", "axis"),
    )
    heat_window: float = parameter(
        0.0654,
        "[rad] half the lidar window around the warm pixels",
        minimum=0.0174,
        maximum=0.262,
    )
    temp_threshold: float = parameter(
        27.0, "[C] that a centre pixel reaches, for absolute", minimum=0.0, maximum=80.0
    )
    heat_rule: str = parameter(
        "contrast",
        "when a frame shows heat: absolute, contrast, or both at once",
        choices=("absolute", "contrast", "both"),
    )
    temp_contrast: float = parameter(
        2.5,
        "[K] of the hottest pixel above the frame's median, for contrast",
        minimum=0.5,
        maximum=20.0,
    )
    heat_distance_max: float = parameter(
        2.5, "[m] beyond which no fix is made", minimum=0.3, maximum=8.0
    )
    mode_bin: float = parameter(
        0.1,
        "[m] width of the bins of range from which the fullest is taken",
        minimum=0.02,
        maximum=0.5,
    )
    clusters: int = parameter(
        0,
        "heat sources at most; 0 for as many as there are",
        minimum=0,
        maximum=20,
    )
    clustering: str = parameter(
        "groups",
        "how fixes become sources: groups (by distance and side) or kmeans",
        choices=("groups", "kmeans"),
    )
    group_distance: float = parameter(
        0.35, "[m] between fixes of one source at most", minimum=0.05, maximum=2.0
    )
    group_least: int = parameter(
        3, "fixes without which a group is no source", minimum=1, maximum=1000
    )
    imu_threshold: float = parameter(
        0.0,
        "times the running mean of the tilt, beyond which the robot backs off; 0 for off",
        minimum=0.0,
        maximum=100.0,
    )
    imu_abs_threshold: float = parameter(
        0.16,
        "[rad] of pitch or roll from level, beyond which the robot backs off at once",
        minimum=0.02,
        maximum=1.0,
    )
    ramp_rise: float = parameter(
        0.06,
        "[rad] of tilt from level in the mean of 0.3 s, beyond which the robot backs off",
        minimum=0.02,
        maximum=0.5,
    )
    ramp_backtrack: int = parameter(
        20, "past poses to back to, one each 0.05 m", minimum=1, maximum=200
    )
    rate_of_placement: int = parameter(
        4, "[cells] around a frontier that a visit makes known", minimum=1, maximum=20
    )
    use_padding: bool = parameter(False, "pad obstacles before frontiers are sought")
    padding: int = parameter(1, "[cells] of that padding", minimum=0, maximum=10)
    fast_explore: bool = parameter(
        False, "explore with the lidar alone, without examining every wall for heat"
    )
    fast_rate: float = parameter(
        10.0, "[1/s] of the sensing that never blocks", minimum=5.0, maximum=20.0
    )
    control_rate: float = parameter(
        1.0, "[1/s] of plans: goals, sources, coverage", minimum=0.2, maximum=5.0
    )
    stand_off: float = parameter(
        0.30, "[m] before a warm wall, where the payload is released", minimum=0.2, maximum=1.0
    )
    stand_off_tolerance: float = parameter(
        0.08, "[m] from there within which it is released", minimum=0.02, maximum=0.5
    )
    ramp_speed: float = parameter(0.15, "[m/s] of the climb", minimum=0.05, maximum=0.22)
    kp_yaw: float = parameter(
        2.0, "[1/s] turn rate per error of the heading, on the ramp", minimum=0.0, maximum=20.0
    )
    kd_yaw: float = parameter(0.1, "of the rate of that error", minimum=0.0, maximum=10.0)
    kp_wall: float = parameter(
        1.0,
        "[rad/s/m] turn rate per difference of the side ranges, on the ramp",
        minimum=0.0,
        maximum=20.0,
    )
    kd_wall: float = parameter(
        0.05, "[rad/m] of the rate of that difference", minimum=0.0, maximum=10.0
    )
    ramp_end: str = parameter(
        "top",
        "where the climb ends: top (the flat part) or wall (stop_front before the wall ahead)",
        choices=("top", "wall"),
    )
    stop_front: float = parameter(
        0.2, "[m] before the wall ahead, when ramp_end is wall", minimum=0.05, maximum=2.0
    )
    ramp_length: float = parameter(
        1.25, "[m] of ground that a ramp takes, from foot to foot", minimum=0.3, maximum=5.0
    )
    thermal_yaw_1: float = parameter(
        1.5184, "[rad] of thermal sensor 1, left positive", minimum=-3.2, maximum=3.2
    )
    thermal_yaw_2: float = parameter(
        0.0, "[rad] of thermal sensor 2, left positive", minimum=-3.2, maximum=3.2
    )
    thermal_delay: float = parameter(
        0.05, "[s] from a thermal frame to its arrival", minimum=0.0, maximum=1.0
    )
    thermal_flip_1: str = parameter("none", "how sensor 1 is mirrored", choices=FLIPS)
    thermal_flip_2: str = parameter("none", "how sensor 2 is mirrored", choices=FLIPS)
    navigator: str = parameter(
        "auto",
        "what drives to goals: nav2, embedded, or auto (nav2 where it is installed)",
        choices=("auto", "nav2", "embedded"),
    )
    stamped_cmd_vel: str = parameter(
        "auto",
        "whether cmd_vel is TwistStamped: true, false, or auto (as its subscriber has it)",
        choices=("auto", "true", "false"),
    )
    time_limit: float = parameter(
        1200.0, "[s] of mission time within which to be done", minimum=10.0, maximum=36000.0
    )
    min_sources: int = parameter(
        1,
        "sources that have to be known before the time may end the exploration",
        minimum=0,
        maximum=20,
    )
    deliver: str = parameter(
        "at_end",
        "when sources are served: at_end of the exploration, or at_once when one is sure",
        choices=("at_end", "at_once"),
    )
    payloads: int = parameter(
        4,
        "sequences on board, one of them kept for the ramp",
        minimum=0,
        maximum=20,
    )
    return_to_start: bool = parameter(False, "drive back to the start when all is done")
    plan_delay: float = parameter(
        0.15,
        "[s] of mission time from what a plan is made of to its effect",
        minimum=0.0,
        maximum=2.0,
    )


def thermal_yaw(config: HeatConfig, sensor: int) -> float:
    """[rad] Mounting of thermal sensor 1 or 2, left positive."""
    return config.thermal_yaw_1 if sensor == 1 else config.thermal_yaw_2


def thermal_flip(config: HeatConfig, sensor: int) -> str:
    """How thermal sensor 1 or 2 is mirrored."""
    return config.thermal_flip_1 if sensor == 1 else config.thermal_flip_2
