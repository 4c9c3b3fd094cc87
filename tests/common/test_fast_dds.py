"""Every node starts with the project's settings of Fast DDS, unless the user has settings."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rover_common.ros.fast_dds import (
    PATIENT_PROFILES,
    PROFILES,
    VARIABLE,
    use_patient_profiles,
)

NAVIGATION_MAP = 800 * 800  # [bytes] the largest message
# A node as run_node starts it; prints the size of the shared memory that its messages lie in.
NODE = """
from pathlib import Path
import rclpy
from rclpy.node import Node
from rover_common.ros.runner import run_node

def start():
    node = Node("probe")
    sizes = [0]
    for line in Path("/proc/self/maps").read_text().splitlines():
        if "fastrtps_" in line and not line.endswith("_el"):
            first, last = (int(address, 16) for address in line.split()[0].split("-"))
            sizes.append(last - first)
    print(max(sizes))
    rclpy.try_shutdown()
    return node

run_node(start)
"""


@pytest.mark.parametrize("value", [None, ""], ids=["ours", "the user's, empty"])
def test_a_node_has_room_for_several_maps_unless_the_user_says_otherwise(value: str | None) -> None:
    environment = {name: text for name, text in os.environ.items() if name != VARIABLE}
    if value is not None:
        environment[VARIABLE] = value
    done = subprocess.run(
        [sys.executable, "-c", NODE], env=environment, capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert (int(done.stdout.split()[-1]) > 8 * NAVIGATION_MAP) == (value is None)


def settings(path: Path) -> dict[str, str]:
    """The text of each element that has one, by its name."""
    elements = ElementTree.parse(path).iter()
    return {each.tag.split("}")[-1]: each.text.strip() for each in elements if each.text}


def test_only_the_time_until_one_is_taken_for_dead_differs_for_the_patient() -> None:
    usual, patient = settings(PROFILES), settings(PATIENT_PROFILES)
    assert usual.pop("healthy_check_timeout_ms") == "1000"
    assert patient.pop("healthy_check_timeout_ms") == "10000"
    assert usual == patient
    assert len(usual) > 10


@pytest.mark.parametrize(
    ("before", "after"),
    [(None, PATIENT_PROFILES), (PROFILES, PATIENT_PROFILES), ("/mine.xml", "/mine.xml"), ("", "")],
)
def test_what_the_user_names_is_for_the_patient_too(monkeypatch, before, after) -> None:
    if before is None:
        monkeypatch.delenv(VARIABLE, raising=False)
    else:
        monkeypatch.setenv(VARIABLE, str(before))
    use_patient_profiles()
    assert os.environ[VARIABLE] == str(after)
