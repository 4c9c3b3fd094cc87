"""The arguments of all launch files: one list, so that a name means the same in each."""

from __future__ import annotations

import math

# Default and meaning by name. A default of None is a file of this package that the launch file
# names; an empty one leaves the value to the parameter file, or to the node.
ARGUMENTS: dict[str, tuple[str | None, str]] = {
    "params_file": (None, "parameters of the nodes"),
    "namespace": ("", "of the nodes and topics, with /tf, /clock and /diagnostics of its own"),
    "frame_prefix": ("", "put before every frame id, such as rover1/"),
    "use_sim_time": ("false", "take the time from /clock"),
    "log_level": ("info", "debug, info, warn, error or fatal"),
    "sim": ("false", "start the simulator, too, and take the time from it"),
    "seed": ("", "of the simulator's world"),
    "sim_rate": ("", "times real time of the simulator, 0 as fast as it goes"),
    "sim_size": ("", "of a generated canyon; 1 is as large as the original"),
    "sim_params_file": (None, "parameters of the simulator"),
    "dashboard": ("true", "serve the live page"),
    "dashboard_port": ("", "TCP port of the live page"),
    "record": ("false", "record all topics"),
    "use_rviz": ("false", "start RViz with this mission's view"),
    "robot_model": ("auto", "robot_state_publisher: true, false, or auto (where it is installed)"),
    "host": ("", "address that the bridge listens on"),
    "port": ("", "TCP port that the bridge listens on"),
    "explorer": ("", "how the rover explores: tour, frontier, classic_a or classic_b"),
    "navigator": ("auto", "nav2, embedded, or auto (nav2 where it is installed)"),
    "slam": ("true", "make the map; false takes the file that map names, which nav2 can"),
    "map": ("", "YAML file of a known map, for slam:=false"),
    "navigation_params_file": ("", "parameters of Nav2, by default those of TURTLEBOT3_MODEL"),
    "slam_params_file": ("", "parameters of slam_toolbox"),
}
SWITCHES = (
    "use_sim_time", "sim", "dashboard", "record", "use_rviz", "slam",
)  # fmt: skip
WHOLE_NUMBERS = {"seed": 2**31 - 1, "port": 65535, "dashboard_port": 65535}  # from 0 to
NUMBERS = ("sim_rate", "sim_size")
LOG_LEVELS = ("debug", "info", "warn", "error", "fatal")
NAVIGATORS = ("auto", "nav2", "embedded")
MODELS = ("auto", "true", "false")

Given = dict[str, str]  # an argument's value by its name


def is_true(value: str) -> bool:
    return value.lower() in ("true", "1")


def problem_of(given: Given) -> str:
    """Why nothing can be started with these values, in one line; empty when it can."""
    for name, value in given.items():
        if name in SWITCHES and value.lower() not in ("true", "false", "1", "0"):
            return f"{name}:={value} is neither true nor false"
        if name in NUMBERS and value and not _is_number(value):
            return f"{name}:={value} is no number"
        if name in WHOLE_NUMBERS and value:
            most = WHOLE_NUMBERS[name]
            if not value.isdecimal() or int(value) > most:
                return f"{name}:={value} is no whole number from 0 to {most}"
    choices = {"log_level": LOG_LEVELS, "navigator": NAVIGATORS, "robot_model": MODELS}
    for name, known in choices.items():
        if name in given and given[name].lower() not in known:
            return f"{name}:={given[name]} is none of {', '.join(known)}"
    return ""


def _is_number(value: str) -> bool:
    try:
        return math.isfinite(float(value))
    except ValueError:
        return False
