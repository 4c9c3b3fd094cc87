"""Presets: files of parameters, as ROS reads them, for what runs without ROS."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

from rover_common.config import problem_of, widened
from rover_common.errors import RoverError
from rover_common.frames import BurgerFrameConfig
from rover_common.input_monitor import InputLimits
from rover_common.yaml_file import YamlFileError, read_yaml
from rover_heat.config import HeatConfig
from rover_heat.node_config import HeatNodeConfig

SECTION, PARAMETERS = "/**/heat_node", "ros__parameters"


class PresetError(RoverError, ValueError):
    """A file of parameters cannot be read, or asks for what is not possible."""


def load_preset(path: Path) -> HeatConfig:
    """The parameters of a file, the defaults for all that it does not name; raises PresetError."""
    try:
        values = dict(read_yaml(path)[SECTION][PARAMETERS])
    except YamlFileError as error:
        raise PresetError(str(error)) from error
    except (KeyError, TypeError, ValueError) as error:
        raise PresetError(f"{path}: no section '{SECTION}' with '{PARAMETERS}'") from error
    # A node's parameters besides those of the mission: how it is connected.
    known = {
        field.name: field
        for kind in (HeatNodeConfig, InputLimits, BurgerFrameConfig)
        for field in fields(kind)
    }
    for name, value in values.items():
        if name not in known:
            raise PresetError(f"{path}: there is no parameter '{name}'")
        problem = problem_of(value, known[name].default, known[name].metadata["parameter"])
        if problem:
            raise PresetError(f"{path}: {name}: {problem}")
    return HeatConfig(
        **{
            field.name: widened(values[field.name], field.default)
            for field in fields(HeatConfig)
            if field.name in values
        }
    )
