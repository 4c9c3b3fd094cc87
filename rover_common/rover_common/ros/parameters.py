"""Declare a configuration dataclass as the parameters of a node."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, TypeVar

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node

from rover_common.config import ParameterInfo
from rover_common.errors import RoverError

C = TypeVar("C")


class ParameterError(RoverError, ValueError):
    """A parameter's value is not one of its choices."""


def declare_parameters(node: Node, config_class: type[C]) -> C:
    """Declare every field of the class, read-only, and return the class filled with the values.

    Raises rclpy's InvalidParameterTypeException or InvalidParameterValueException for a wrong type
    or range, and ParameterError for a value that is not one of the choices.
    """
    values: dict[str, Any] = {}
    for field in fields(config_class):  # type: ignore[arg-type]
        info: ParameterInfo = field.metadata["parameter"]
        parameter = node.declare_parameter(
            field.name, field.default, _descriptor(info, field.default)
        )
        values[field.name] = parameter.value
        if info.choices and parameter.value not in info.choices:
            raise ParameterError(
                f"{field.name}: '{parameter.value}' is not one of {', '.join(info.choices)}"
            )
    return config_class(**values)


def _descriptor(info: ParameterInfo, default: Any) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(description=info.description, read_only=True)
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
