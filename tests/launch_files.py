"""Launch files as they are written: they cannot be imported where launch is not installed."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

from readme_tables import ROOT

FOLDER = ROOT / "rover_bringup" / "launch"


def constant_of(file: Path, name: str) -> Any:
    """A literal of a launch file."""
    for statement in ast.parse(file.read_text()).body:
        if isinstance(statement, ast.Assign) and ast.unparse(statement.targets[0]) == name:
            return ast.literal_eval(statement.value)
    raise AssertionError(f"{file.name} has no {name}")
