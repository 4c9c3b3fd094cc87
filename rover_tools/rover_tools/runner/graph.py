"""The three nodes as processes, started as `ros2 run` would."""

from __future__ import annotations

import socket
from collections.abc import Collection, Mapping
from pathlib import Path

from ament_index_python.packages import get_package_prefix, get_package_share_directory

from rover_tools.runner.processes import Processes

NODES = {
    "bridge_node": "rover_bridge",
    "perception_node": "rover_perception",
    "decision_node": "rover_decision",
}
DASHBOARD = "dashboard_node"
HOST = "127.0.0.1"


def default_parameters() -> Path:
    """The parameter file that ships."""
    return Path(get_package_share_directory("rover_bringup")) / "config" / "rover.yaml"


def executable(package: str, name: str) -> str:
    """The installed executable of a package."""
    return str(Path(get_package_prefix(package)) / "lib" / package / name)


def free_port(preferred: int = 0) -> int:
    """A TCP port on the loopback that is free now: the preferred one, if it is."""
    for port in (preferred, 0):
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((HOST, port))
            except OSError:
                continue
            return int(probe.getsockname()[1])
    raise OSError(f"no TCP port is free on {HOST}")


def start_graph(
    processes: Processes,
    port: int,
    parameters_file: Path,
    overrides: Mapping[str, Mapping[str, object]],
    nodes: Collection[str] = NODES,
) -> None:
    """Start these nodes in simulated time, the bridge on this port.

    `overrides` holds parameter values by node name, over those of the file.
    """
    for node in nodes:
        package = NODES[node]
        # Whoever wants to go on after a crash says where states are kept.
        values = {"use_sim_time": True, "state_dir": "", **overrides.get(node, {})}
        if node == "bridge_node":
            values |= {"host": HOST, "port": port}
        processes.start(node, node_command(package, node, parameters_file, values))


def node_command(
    package: str, node: str, parameters_file: Path, values: Mapping[str, object]
) -> list[str]:
    """What starts a node with these parameters over those of the file.

    Its output is its log: a file of ROS with the same text is not written.
    """
    command = [executable(package, node), "--ros-args", "--disable-external-lib-logs"]
    command += ["--params-file", str(parameters_file)]
    for name, value in values.items():
        command += ["-p", f"{name}:={_yaml_scalar(value)}"]
    return command


def _yaml_scalar(value: object) -> str:
    if value == "":
        return '""'
    return str(value).lower() if isinstance(value, bool) else str(value)
