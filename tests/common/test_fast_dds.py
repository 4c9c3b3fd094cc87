"""Every node starts with the project's settings of Fast DDS, unless the user has settings."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

from rover_common.ros.fast_dds import (
    DEAD_AFTER,
    PROFILES,
    VARIABLE,
    use_patient_profiles,
    use_profiles,
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


def test_the_settings_ask_for_nothing_that_is_not_set(monkeypatch) -> None:
    asked = re.findall(r"\$\{(\w+)\}", PROFILES.read_text())
    assert asked == [DEAD_AFTER]
    monkeypatch.delenv(DEAD_AFTER, raising=False)
    use_profiles()
    assert os.environ[DEAD_AFTER] == "1000"


@pytest.mark.parametrize("named", [None, "/mine.xml", ""])
def test_the_patient_wait_longer_with_the_file_that_the_environment_names(
    monkeypatch, named
) -> None:
    monkeypatch.setenv(DEAD_AFTER, "1000")  # as of a parent
    if named is None:
        monkeypatch.delenv(VARIABLE, raising=False)
    else:
        monkeypatch.setenv(VARIABLE, named)
    use_patient_profiles()
    assert os.environ[DEAD_AFTER] == "5000"
    assert os.environ[VARIABLE] == (str(PROFILES) if named is None else named)
