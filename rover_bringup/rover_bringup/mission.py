"""The rover's graph: simulator on request, bridge, perception, decision, and what shows them."""

from __future__ import annotations

from pathlib import Path

from rover_bringup.arguments import Given, is_true
from rover_bringup.starts import (
    AtEnd,
    LaunchError,
    Plan,
    Start,
    check,
    is_installed,
    page_and_recorder,
    parameter_values,
    rviz,
    shared_values,
    shipped,
)

NAMES = (
    "params_file", "sim", "seed", "sim_rate", "sim_size", "explorer", "host", "port", "namespace",
    "frame_prefix", "use_sim_time", "log_level", "dashboard", "dashboard_port", "record",
    "use_rviz", "robot_model",
)  # fmt: skip
MODEL = "robot_state_publisher"


def plan(given: Given) -> Plan:
    """Raises LaunchError."""
    check(given)
    files = (given["params_file"],)
    shared = shared_values(given)
    address = parameter_values(given, {"host": ("host", str), "port": ("port", int)})
    model = robot_model(given)
    bridge = {**shared, **address}
    if model:
        bridge["camera_transforms"] = False  # which the model has as well
    explorer = parameter_values(given, {"explorer": ("explorer", str)})
    nodes = [
        Start("rover_bridge", "bridge_node", AtEnd.SHUTDOWN, files, bridge),
        Start("rover_perception", "perception_node", AtEnd.RESPAWN, files, shared),
        Start("rover_decision", "decision_node", AtEnd.RESPAWN, files, {**shared, **explorer}),
    ]
    watching = page_and_recorder(given, files, "rover")
    return [*nodes, *simulator(given, files), *model, *watching, *rviz(given, "rover.rviz")]


def simulator(given: Given, files: tuple[str, ...]) -> Plan:
    """It connects to the bridge; its telemetry has the time that /clock is made of."""
    if not is_true(given["sim"]):
        return []
    values = parameter_values(
        given,
        {
            "seed": ("seed", int),
            "sim_rate": ("rate", float),
            "sim_size": ("size", float),
            "port": ("port", int),
        },
    )
    return [Start("rover_simulator", "simulator_node", AtEnd.SHUTDOWN, files, values)]


def robot_model(given: Given) -> Plan:
    """The rover's URDF, by robot_state_publisher."""
    wanted = given["robot_model"].lower()
    if wanted == "true" and not is_installed(MODEL):
        raise LaunchError(f"robot_model:=true needs the package {MODEL}")
    if wanted == "false" or not is_installed(MODEL):
        return []
    values = {
        **shared_values(given),
        "robot_description": Path(shipped("urdf", "rover.urdf")).read_text(),
    }
    return [Start(MODEL, MODEL, AtEnd.RESPAWN, values=values)]
