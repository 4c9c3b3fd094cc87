"""`colcon test` finds the tests: it calls pytest in each package's folder."""

from __future__ import annotations

import configparser
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = sorted(path.parent.name for path in ROOT.glob("*/setup.cfg"))
SHARED = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["pytest"]["ini_options"]


def settings_of(package: str) -> dict[str, list[str]]:
    parser = configparser.ConfigParser()
    parser.read(ROOT / package / "setup.cfg")
    return {name: value.split() for name, value in parser["tool:pytest"].items()}


def test_each_folder_of_tests_belongs_to_one_package():
    folders = {path.parent.relative_to(ROOT) for path in (ROOT / "tests").rglob("test_*.py")}
    named = [path for package in PACKAGES for path in settings_of(package)["testpaths"]]
    assert sorted(named) == sorted(f"../{folder}" for folder in folders)


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_has_the_settings_of_all(package):
    settings = settings_of(package)
    del settings["testpaths"]
    assert settings == {
        "addopts": SHARED["addopts"].split(),
        "pythonpath": [f"../{path}" for path in SHARED["pythonpath"]],
        "filterwarnings": SHARED["filterwarnings"],
    }


@pytest.mark.parametrize("package", PACKAGES)
def test_colcon_takes_pytest_for_a_package(package):
    """It looks for a test dependency of this name; unittest, its other choice, finds nothing."""
    assert 'extras_require={"test": ["pytest"]}' in (ROOT / package / "setup.py").read_text()


def test_pytest_in_a_package_finds_its_tests_and_their_fixtures():
    environment = {name: value for name, value in os.environ.items() if "PYTEST" not in name}
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", "test_codec"],
        cwd=ROOT / "rover_bridge",
        env=environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert " passed" in done.stdout
