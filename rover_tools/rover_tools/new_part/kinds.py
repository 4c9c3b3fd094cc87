"""Kinds of parts, and how their skeletons come about."""

from __future__ import annotations

import keyword
import re
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from rover_common.errors import RoverError
from rover_common.registry import Registry
from rover_common.whole_file import write_whole
from rover_decision.missions.sample_return.explorer_names import EXPLORERS
from rover_perception.recipe_names import RECIPES

CAUSE = re.compile(r"error: \S+ ", re.IGNORECASE)  # in pip's messages
NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")
TEMPLATES = Environment(
    loader=PackageLoader(__package__, "templates"),
    undefined=StrictUndefined,
    keep_trailing_newline=True,
)


class NewPartError(RoverError):
    """A skeleton that cannot be made."""


@dataclass(frozen=True)
class Kind:
    """What its skeletons have in common."""

    registry: Registry
    module: str  # of the part, also the names of its templates
    part: str  # the object in it
    strategy: str  # how a command names it, with {} for the name
    beside: str  # the strategy that the scoreboard compares it with
    worlds: str  # how many small canyons that takes


KINDS: Mapping[str, Kind] = {
    "explorer": Kind(EXPLORERS, "explorer", "explorer", "{}", "tour", "1-4"),
    "perception": Kind(RECIPES, "perception", "recipe", "tour@{}", "tour@baseline", "1-2"),
}


def next_commands(kind: Kind, name: str, folder: Path) -> list[str]:
    """What to call when a part has been made."""
    strategy = kind.strategy.format(name)
    board = f"--worlds {kind.worlds} --size 0.4 --fps 12.5 --strategies {kind.beside},{strategy}"
    return [
        f"./rover test {folder}",
        f"./rover demo --strategy {strategy}",
        f"./rover scoreboard {board}",
    ]


def check_name(kind: Kind, name: str) -> None:
    """Raises NewPartError for one that cannot be the name of a package and of a part."""
    if not NAME.fullmatch(name) or keyword.iskeyword(name):
        raise NewPartError(
            f"'{name}' is no name; write up to 40 lower-case letters, digits and underscores, a "
            "letter first"
        )
    if name in kind.registry:
        raise NewPartError(f"there is {kind.registry.kind} '{name}' already; choose another name")
    if find_spec(name) is not None:
        raise NewPartError(f"there is a Python package '{name}' already; choose another name")


def write_skeleton(kind: Kind, name: str, folder: Path) -> None:
    """A package with the part and its test; raises NewPartError for a folder that is there."""
    if folder.exists():
        raise NewPartError(f"{folder} is there already; choose another name or --out")
    check_name(kind, name)
    values = {
        "name": name,
        "group": kind.registry.group,
        "module": kind.module,
        "part": kind.part,
        "commands": next_commands(kind, name, Path(name)),
    }
    files = {
        "pyproject.toml": "pyproject.toml.j2",
        "README.md": "README.md.j2",
        f"src/{name}/__init__.py": "init.py.j2",
        f"src/{name}/{kind.module}.py": f"{kind.module}.py.j2",
        f"tests/test_{name}.py": f"{kind.module}_test.py.j2",
    }
    for path, template in files.items():
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        write_whole(file, TEMPLATES.get_template(template).render(values))


def install_command(folder: Path) -> list[str]:
    """Of pip, for a package whose files stay where they are."""
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
    return [*command, "--no-input", "--no-deps", "--no-build-isolation", "--editable", str(folder)]


def install(folder: Path) -> None:
    """Run that command; raises NewPartError."""
    done = subprocess.run(install_command(folder), capture_output=True, text=True)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["no message"]
        told = [line.strip() for line in lines if CAUSE.search(line)]  # pip ends with a hint
        raise NewPartError(f"pip cannot install {folder}: {(told or lines)[-1]}")
