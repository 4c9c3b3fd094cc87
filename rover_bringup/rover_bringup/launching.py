"""A plan as actions of launch: the only module here that imports it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from launch import LaunchContext, LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    IncludeLaunchDescription,
    OpaqueFunction,
    Shutdown,
)
from launch.events.process import ProcessExited
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from rover_bringup.arguments import ARGUMENTS, Given
from rover_bringup.starts import AtEnd, Include, Plan, Start, ends_all, remappings_of, shipped

RESPAWN_DELAY = 1.0  # [s]


def description_of(
    names: Sequence[str], files: Mapping[str, str], plan: Callable[[Given], Plan]
) -> LaunchDescription:
    """Declares the arguments, and starts what is planned with their values.

    files: the parameter file of this package that is the default, by argument. The whole plan is
    made before anything starts: what it raises leaves no node behind.
    """

    def start(context: LaunchContext) -> list[Any]:
        given = {name: LaunchConfiguration(name).perform(context) for name in names}
        return [_action_of(each, given) for each in plan(given)]

    return LaunchDescription(
        [*(_declared(name, files) for name in names), OpaqueFunction(function=start)]
    )


def _declared(name: str, files: Mapping[str, str]) -> DeclareLaunchArgument:
    default, meaning = ARGUMENTS[name]
    if default is None:
        default = shipped("config", files[name])
    return DeclareLaunchArgument(name, default_value=default, description=meaning)


def _action_of(planned: Start | Include, given: Given) -> Any:
    if isinstance(planned, Include):
        arguments = list(planned.arguments.items())
        return IncludeLaunchDescription(planned.file, launch_arguments=arguments)
    values = {name: _value_of(value) for name, value in planned.values.items()}

    def on_exit(event: ProcessExited, _: LaunchContext) -> Shutdown | None:
        ends = ends_all(planned.at_end, event.returncode)
        return Shutdown(reason=f"{planned.executable} has ended") if ends else None

    return Node(
        package=planned.package,
        executable=planned.executable,
        name=None if planned.name == "-" else planned.name or planned.executable,
        namespace=given["namespace"],
        output="screen",
        parameters=[*planned.files, *([values] if values else [])],
        remappings=[*remappings_of(given), *planned.remappings],
        arguments=[*planned.arguments, "--ros-args", "--log-level", given["log_level"]],
        respawn=planned.at_end is AtEnd.RESPAWN,
        respawn_delay=RESPAWN_DELAY,
        on_exit=on_exit,
    )


def _value_of(value: object) -> object:
    """A text stays one, whatever YAML would take it for."""
    return ParameterValue(value, value_type=str) if isinstance(value, str) else value
