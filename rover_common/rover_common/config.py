"""Declare a parameter once: as a field of a core's configuration dataclass.

A configuration is a frozen dataclass whose fields come from `parameter`. The node declares them as
ROS parameters from these fields; the shipped YAML lists the same names.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Any, TypeVar

T = TypeVar("T", bool, int, float, str)

# Default and description of the parameter state_dir, which several nodes have.
STATE_DIR = (
    "auto",
    "folder for what the node knows again when it is started again in the same run; auto: one below"
    " ROS_HOME, empty: none",
)


@dataclass(frozen=True)
class ParameterInfo:
    """What a node tells of a parameter in its descriptor."""

    description: str  # with the unit in square brackets
    minimum: float | None = None
    maximum: float | None = None
    choices: Collection[str] = ()
    settable: bool = False  # while the node runs; the others are read at the start


def parameter(
    default: T,
    description: str,
    *,
    minimum: float | None = None,
    maximum: float | None = None,
    choices: Collection[str] = (),
    settable: bool = False,
) -> Any:
    """A dataclass field that is also a ROS parameter."""
    info = ParameterInfo(description, minimum, maximum, choices, settable)
    return field(default=default, metadata={"parameter": info})


def widened(value: Any, default: Any) -> Any:
    """An integer as a float where the default is one: nobody should have to write 3.0 for 3."""
    return float(value) if type(default) is float and type(value) is int else value


def problem_of(value: Any, default: Any, info: ParameterInfo) -> str:
    """Why a parameter cannot have a value; empty when it can."""
    value = widened(value, default)
    if type(value) is not type(default):
        return f"{value!r} is no {type(default).__name__}"
    if info.choices and value not in info.choices:
        return f"'{value}' is not one of {', '.join(info.choices)}"
    if info.minimum is not None and info.maximum is not None:
        inside = info.minimum <= value <= info.maximum
        return "" if inside else f"{value} is not within {info.minimum} to {info.maximum}"
    return ""
