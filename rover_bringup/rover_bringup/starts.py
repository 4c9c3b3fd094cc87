"""What a launch file starts, as data: a test reads it where launch is not installed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from rover_bringup.arguments import Given, is_true, problem_of
from rover_common.errors import CANNOT_START, RoverError

PACKAGE = "rover_bringup"
# Topics that are one for all robots, unless each has a namespace; relative, each has its own.
SHARED = ("/tf", "/tf_static", "/clock", "/diagnostics")


class LaunchError(RoverError, RuntimeError):
    """Nothing is started: an argument cannot be used, or a package is missing."""


class AtEnd(Enum):
    """What follows when a node ends."""

    RESPAWN = "it is started again"  # unless it cannot start, see ends_all
    SHUTDOWN = "all other nodes end as well"
    NOTHING = "the others go on"


def ends_all(at_end: AtEnd, exit_code: int) -> bool:
    """Whether the other nodes end as well. One that refuses its parameters would do so for ever."""
    return at_end is AtEnd.SHUTDOWN or (at_end is AtEnd.RESPAWN and exit_code == CANNOT_START)


@dataclass(frozen=True)
class Start:
    """One node."""

    package: str
    executable: str
    at_end: AtEnd = AtEnd.NOTHING
    files: tuple[str, ...] = ()  # of parameters
    values: Mapping[str, object] = field(default_factory=dict)  # of parameters, over the files'
    name: str = ""  # the executable's where it is empty
    remappings: tuple[tuple[str, str], ...] = ()
    arguments: tuple[str, ...] = ()


@dataclass(frozen=True)
class Include:
    """The launch file of another package."""

    file: str
    arguments: Mapping[str, str]


Plan = list[Start | Include]


def is_installed(package: str) -> bool:
    try:
        get_package_share_directory(package)
    except PackageNotFoundError:
        return False
    return True


def shipped(folder: str, name: str) -> str:
    """A file of this package."""
    return str(Path(get_package_share_directory(PACKAGE)) / folder / name)


def check(given: Given) -> None:
    """Raises LaunchError before anything is started."""
    problem = problem_of(given)
    if problem:
        raise LaunchError(problem)
    for name, value in given.items():
        if name.endswith("params_file") and value and not Path(value).is_file():
            raise LaunchError(f"{name}:={value} is no file")
    if is_true(given.get("use_rviz", "false")) and not is_installed("rviz2"):
        raise LaunchError("use_rviz:=true needs the package rviz2")


def shared_values(given: Given) -> dict[str, object]:
    """Parameters that every node of a mission gets."""
    in_sim_time = is_true(given["use_sim_time"]) or is_true(given.get("sim", "false"))
    prefix = given.get("frame_prefix", "")
    return {"use_sim_time": in_sim_time} | ({"frame_prefix": prefix} if prefix else {})


def parameter_values(
    given: Given, names: Mapping[str, tuple[str, Callable[[str], object]]]
) -> dict:
    """Parameter values of the arguments that were given: parameter and type by argument."""
    return {
        parameter: kind(given[name]) for name, (parameter, kind) in names.items() if given[name]
    }


def remappings_of(given: Given) -> tuple[tuple[str, str], ...]:
    """As Nav2 does it: in a namespace, the shared topics are relative to it."""
    if not given["namespace"].strip("/"):
        return ()
    return tuple((topic, topic.removeprefix("/")) for topic in SHARED)


def page_and_recorder(given: Given, files: tuple[str, ...], mission: str) -> Plan:
    """What shows and records a mission, each on request."""
    plan: Plan = []
    if is_true(given["dashboard"]):
        values = parameter_values(given, {"dashboard_port": ("port", int)})
        plan.append(Start("rover_dashboard", "dashboard_node", files=files, values=values))
    if is_true(given["record"]):
        values = {"mission": mission}
        plan.append(Start("rover_recorder", "recorder_node", files=files, values=values))
    return plan


def rviz(given: Given, view: str) -> Plan:
    """RViz in the robot's namespace, where the view's relative topics are."""
    if not is_true(given["use_rviz"]):
        return []
    fixed = f"{given.get('frame_prefix', '')}map"
    arguments = ("-d", shipped("rviz", view), "-f", fixed)
    values = {"use_sim_time": shared_values(given)["use_sim_time"]}
    return [Start("rviz2", "rviz2", arguments=arguments, values=values)]
