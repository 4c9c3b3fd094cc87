"""Variables that turn a graph away from itself; nothing here imports more than the library."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from rover_tools.doctor.finding import Finding, note, wrong

HIGHEST_DOMAIN = 232
RANGES = ("SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT")
DISTRIBUTION = "jazzy"
PROFILES = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")


def check_domain(variables: Mapping[str, str]) -> Finding:
    name, domain = "domain", variables.get("ROS_DOMAIN_ID", "")
    if not domain:
        return Finding(name)
    if not (domain.isdecimal() and int(domain) <= HIGHEST_DOMAIN):
        return wrong(
            name, f"ROS_DOMAIN_ID={domain} is no domain: set 0 to {HIGHEST_DOMAIN}, or unset it"
        )
    return note(
        name,
        f"ROS_DOMAIN_ID={domain}: only nodes of this domain find each other; unset it to let each "
        "run take a free one",
    )


def check_discovery(variables: Mapping[str, str]) -> Finding:
    name = "discovery"
    reach = variables.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "")
    if reach and reach not in RANGES:
        known = ", ".join(RANGES)
        return wrong(name, f"ROS_AUTOMATIC_DISCOVERY_RANGE={reach} is none of {known}: unset it")
    if reach == "OFF":
        return wrong(name, "ROS_AUTOMATIC_DISCOVERY_RANGE=OFF: no node finds another; unset it")
    if variables.get("ROS_DISCOVERY_SERVER"):
        return wrong(
            name, "ROS_DISCOVERY_SERVER is set: nodes wait for that server; start it, or unset it"
        )
    middleware = variables.get("RMW_IMPLEMENTATION", "")
    if middleware not in ("", "rmw_fastrtps_cpp"):
        return wrong(name, f"RMW_IMPLEMENTATION={middleware} is not rmw_fastrtps_cpp: unset it")
    for variable in PROFILES:
        file = variables.get(variable, "")
        if file and not Path(file).is_file():
            return wrong(name, f"{variable} names {file}, which is no file; unset it")
    if variables.get("ROS_LOCALHOST_ONLY") not in (None, "", "0"):
        return note(
            name,
            "ROS_LOCALHOST_ONLY is set, which Jazzy replaces: unset it and use "
            "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST",
        )
    return Finding(name)


def check_other_ros(variables: Mapping[str, str]) -> Finding:
    name = "other ROS"
    distribution = variables.get("ROS_DISTRO", "")
    if distribution not in ("", DISTRIBUTION):
        return note(
            name,
            f"ROS {distribution} is sourced: ./rover sets it aside, but nodes started by hand "
            "would mix both; open a shell without it",
        )
    return Finding(name)


def check_python_path(variables: Mapping[str, str]) -> Finding:
    """Folders of a sourced ROS are part of it; any other takes the place of our modules."""
    name = "PYTHONPATH"
    prefixes = [part for part in variables.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if part]
    folders = [part for part in variables.get("PYTHONPATH", "").split(os.pathsep) if part]
    foreign = [part for part in folders if not part.startswith(tuple(prefixes))]
    if not foreign:
        return Finding(name)
    return note(
        name,
        f"it holds {foreign[0]}, whose modules can take the place of the libraries; "
        "unset PYTHONPATH for nodes that are started by hand",
    )
