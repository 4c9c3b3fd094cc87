"""What rosdep and pip install: each dependency has a key that exists, or is in the venv."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = sorted(path.parent.name for path in ROOT.glob("*/package.xml"))
LOCK, WITH_APT = ROOT / "wheels/requirements-noble.lock", ROOT / "wheels/requirements-apt.txt"
# The distribution of each key that rosdep does not know; engineio comes with python3-socketio.
SKIPPED = {
    "python3-av-pip": "av",
    "python3-distributed-pip": "distributed",
    "python3-embreex-pip": "embreex",
    "python3-engineio": None,
    "python3-eventlet": "eventlet",
    "python3-mcap-pip": "mcap",
    "python3-mujoco-core-pip": "mujoco-core",
    "python3-python-statemachine-pip": "python-statemachine",
    "python3-zstandard": "zstandard",
}


def lines_of(path: Path) -> set[str]:
    return {line for line in path.read_text().splitlines() if line and not line.startswith("#")}


def dependencies(package: str) -> set[str]:
    root = ElementTree.parse(ROOT / package / "package.xml").getroot()
    return {str(element.text) for element in root if element.tag.endswith("depend")}


@pytest.mark.parametrize("package", PACKAGES)
def test_each_dependency_has_a_key_or_is_skipped(package):
    known = lines_of(ROOT / "wheels" / "rosdep-keys.txt")
    assert not dependencies(package) - known - set(SKIPPED) - set(PACKAGES)


def test_what_is_skipped_is_needed_and_has_no_key():
    assert set(SKIPPED) <= set().union(*map(dependencies, PACKAGES))
    assert not set(SKIPPED) & lines_of(ROOT / "wheels" / "rosdep-keys.txt")


@pytest.mark.parametrize("name", ["docs/install.md", "docker/Dockerfile"])
def test_the_instructions_skip_the_same_keys(name):
    text = (ROOT / name).read_text().replace("\\\n", " ")
    (keys,) = re.findall(r'--skip-keys "([^"]*)"', text)
    assert keys.split() == sorted(SKIPPED)


def test_what_is_skipped_is_installed_into_the_venv_in_the_versions_that_are_tested():
    pins = lines_of(WITH_APT)
    assert {name for name in SKIPPED.values() if name} <= {pin.split("==")[0] for pin in pins}
    assert pins <= lines_of(LOCK)


def test_the_lock_holds_what_is_asked_for():
    def canonical(pins: set[str]) -> set[str]:
        return {pin.lower().replace("_", "-") for pin in pins}

    wanted = lines_of(ROOT / "wheels" / "requirements-noble.txt")
    assert canonical(wanted) <= canonical(lines_of(LOCK))
