"""The heat mission's graph: simulator on request, navigator, mission, and what shows them."""

from __future__ import annotations

from rover_bringup import navigation
from rover_bringup.arguments import Given, is_true
from rover_bringup.starts import (
    AtEnd,
    Plan,
    Start,
    check,
    page_and_recorder,
    parameter_values,
    rviz,
    shared_values,
    shipped,
)

CONTROLLER_NAMES = (
    "params_file", "namespace", "frame_prefix", "use_sim_time", "log_level",
)  # fmt: skip
NAMES = (
    "params_file", "sim", "seed", "sim_rate", "sim_params_file", "navigator", "slam", "map",
    "navigation_params_file", "slam_params_file", "namespace", "frame_prefix", "use_sim_time",
    "log_level", "dashboard", "dashboard_port", "record", "use_rviz",
)  # fmt: skip


def plan(given: Given) -> Plan:
    """Raises LaunchError."""
    check(given)
    watching = page_and_recorder(given, (shipped("config", "rover.yaml"),), "heat")
    return [
        *simulator(given),
        *navigation.plan(given),
        *controller(given),
        *watching,
        *rviz(given, "heat.rviz"),
    ]


def controller(given: Given) -> Plan:
    """The mission node alone."""
    check(given)
    files, shared = (given["params_file"],), shared_values(given)
    return [Start("rover_heat", "heat_node", AtEnd.RESPAWN, files, shared)]


def simulator(given: Given) -> Plan:
    """In place of a robot. It makes /clock and does not follow it."""
    if not is_true(given["sim"]):
        return []
    values = parameter_values(given, {"seed": ("seed", int), "sim_rate": ("rate", float)})
    if given["frame_prefix"]:
        values["frame_prefix"] = given["frame_prefix"]
    files = (given["sim_params_file"],)
    return [Start("burger_simulator", "burger_node", AtEnd.SHUTDOWN, files, values)]
