"""Declare a configuration dataclass as the parameters of a node."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any, TypeVar

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.node import Node
from rclpy.parameter import Parameter

from rover_common.config import ParameterInfo, widened
from rover_common.errors import RoverError

C = TypeVar("C")


class ParameterError(RoverError, ValueError):
    """A parameter's value has a wrong type, or is out of its range or none of its choices."""


def declare_parameters(
    node: Node, config_class: type[C], on_change: Callable[[C], None] | None = None
) -> C:
    """Declare every field of the class, and return the class filled with the values.

    Fields that are settable may be set while the node runs, within the same ranges and choices;
    `on_change` is called with the new configuration then. All others are read-only, and without
    `on_change` every one is. An integer is taken for a float.

    Raises ParameterError for a value of a wrong type or range, or that is not one of the choices.
    """
    values: dict[str, Any] = {}
    infos: dict[str, ParameterInfo] = {}
    for field in fields(config_class):  # type: ignore[arg-type]
        info: ParameterInfo = field.metadata["parameter"]
        infos[field.name] = info
        read_only = on_change is None or not info.settable
        _widen_given(node, field.name, field.default)
        try:
            parameter = node.declare_parameter(
                field.name, field.default, _descriptor(info, field.default, read_only)
            )
        except (InvalidParameterTypeException, InvalidParameterValueException) as error:
            raise ParameterError(_expected(field.name, field.default, info)) from error
        values[field.name] = parameter.value
        problem = _problem(info, parameter)
        if problem:
            raise ParameterError(problem)
    config = config_class(**values)
    if on_change is not None:
        defaults = {field.name: field.default for field in fields(config_class)}  # type: ignore[arg-type]
        node.add_pre_set_parameters_callback(partial(_widen, defaults))
        _follow(node, config, infos, on_change)
    return config


def unknown_parameters(node: Node) -> list[str]:
    """Names that a file or the command line sets, and that the node has not declared.

    ROS ignores them. Each is followed by the nearest name that there is.
    """
    given = node._parameter_overrides  # not among rclpy's public names
    known = [name for name in node._parameters if name not in given]
    told = []
    for name in sorted(given):
        if not node.has_parameter(name) and not name.startswith("qos_overrides."):
            near = difflib.get_close_matches(name, known, 1)
            told.append(f"'{name}'; did you mean '{near[0]}'?" if near else f"'{name}'")
    return told


def _widen_given(node: Node, name: str, default: Any) -> None:
    """Of a value that a file or the command line sets."""
    given = node._parameter_overrides  # not among rclpy's public names
    if name in given and (value := widened(given[name].value, default)) is not given[name].value:
        given[name] = Parameter(name, value=value)


def _widen(defaults: dict[str, Any], parameters: list[Parameter]) -> list[Parameter]:
    """Of values that are to be set while the node runs."""
    return [Parameter(p.name, value=widened(p.value, defaults.get(p.name))) for p in parameters]


def _expected(name: str, default: Any, info: ParameterInfo) -> str:
    kind = {bool: "true or false", int: "an integer", float: "a number", str: "a text"}
    limits = "" if info.minimum is None else f" from {info.minimum} to {info.maximum}"
    return f"the parameter {name} has to be {kind[type(default)]}{limits}"


def _follow(
    node: Node, config: C, infos: dict[str, ParameterInfo], on_change: Callable[[C], None]
) -> None:
    """Check what is to be set, and pass on what was set; rclpy itself checks types and ranges."""

    def check(parameters: Sequence[Parameter]) -> SetParametersResult:
        problems = [_problem(infos[p.name], p) for p in parameters if p.name in infos]
        reason = "; ".join(problem for problem in problems if problem)
        return SetParametersResult(successful=not reason, reason=reason)

    def pass_on(parameters: Sequence[Parameter]) -> None:
        nonlocal config
        new = {p.name: p.value for p in parameters if p.name in infos}
        if new:
            config = replace(config, **new)  # type: ignore[type-var]
            on_change(config)

    node.add_on_set_parameters_callback(check)
    node.add_post_set_parameters_callback(pass_on)


def _problem(info: ParameterInfo, parameter: Parameter) -> str:
    """Why the value is not one of the choices; empty when it is."""
    if not info.choices or parameter.value in info.choices:
        return ""
    return f"{parameter.name}: '{parameter.value}' is not one of {', '.join(info.choices)}"


def _descriptor(info: ParameterInfo, default: Any, read_only: bool) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(description=info.description, read_only=read_only)
    if info.choices:
        descriptor.additional_constraints = "one of: " + ", ".join(info.choices)
    if info.minimum is not None and info.maximum is not None:
        if isinstance(default, float):
            descriptor.floating_point_range = [
                FloatingPointRange(from_value=float(info.minimum), to_value=float(info.maximum))
            ]
        else:
            descriptor.integer_range = [
                IntegerRange(from_value=int(info.minimum), to_value=int(info.maximum), step=1)
            ]
    return descriptor
