"""A file of parameters, checked before any node starts: ROS ignores a name that no node has."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from dataclasses import Field, fields
from pathlib import Path
from typing import Any

from rover_bridge.config import BridgeConfig, CameraFrameConfig
from rover_common.config import problem_of
from rover_common.errors import RoverError
from rover_common.frames import FrameConfig
from rover_common.input_monitor import InputLimits
from rover_common.ros.lifecycle import LifecycleConfig
from rover_common.yaml_file import YamlFileError, read_yaml
from rover_dashboard.config import DashboardConfig
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_perception.config import PerceptionConfig
from rover_recorder.config import RecorderConfig
from rover_simulator.config import SimulatorConfig

CONFIGS = {
    "bridge_node": (BridgeConfig, InputLimits, LifecycleConfig, CameraFrameConfig),
    "perception_node": (PerceptionConfig, InputLimits, FrameConfig),
    "decision_node": (DecisionConfig, InputLimits, FrameConfig),
    "simulator_node": (SimulatorConfig, LifecycleConfig),
    "dashboard_node": (DashboardConfig,),
    "recorder_node": (RecorderConfig,),
}
ALL_NODES = "/**"
SECTION = "ros__parameters"
OF_ROS = ("use_sim_time", "qos_overrides.")  # which every node has

Known = dict[str, "Field[Any]"]


class ParametersError(RoverError, ValueError):
    """A parameter file that cannot be used."""


def read_parameters(path: Path) -> dict[str, dict[str, Any]]:
    """The values of each of our nodes by its name, those for all nodes among them.

    Raises ParametersError for a file that is none, a parameter that none of the nodes has, and a
    value that it cannot have; sections of other nodes are left alone.
    """
    try:
        sections = read_yaml(path) or {}
        given = {str(name): dict(section[SECTION] or {}) for name, section in sections.items()}
    except YamlFileError as error:
        raise ParametersError(f"{error}: not a parameter file") from error
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise ParametersError(f"{path}: not a parameter file: no '{SECTION}'") from error
    found: dict[str, dict[str, Any]] = {name: {} for name in CONFIGS}
    for name, values in given.items():
        nodes = list(_nodes_of(path, name))
        known = {
            each.name: each for node in nodes for kind in CONFIGS[node] for each in fields(kind)
        }
        for parameter, value in values.items() if nodes else ():
            _check(path, name, str(parameter), value, known)
        for node in nodes:
            found[node] |= values
    return found


def _nodes_of(path: Path, section: str) -> Iterator[str]:
    if section == ALL_NODES:
        yield from CONFIGS
        return
    name = section.rsplit("/", 1)[-1]
    if name in CONFIGS:
        yield name
        return
    near = difflib.get_close_matches(name, CONFIGS, 1, 0.8)
    if near:
        raise ParametersError(f"{path}: no node '{name}'; did you mean '{near[0]}'?")


def _check(path: Path, section: str, name: str, value: Any, known: Known) -> None:
    if name.startswith(OF_ROS):
        return
    if name not in known:
        near = difflib.get_close_matches(name, known, 1)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        raise ParametersError(f"{path}: {section}: there is no parameter '{name}'{hint}")
    problem = problem_of(value, known[name].default, known[name].metadata["parameter"])
    if problem:
        raise ParametersError(f"{path}: {section}: {name}: {problem}")
