"""Every error class of the packages is an expected error: it derives from RoverError."""

from __future__ import annotations

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BASE = "RoverError"


def error_classes() -> dict[str, list[set[str]]]:
    """Names of the bases of every class whose name ends in Error, by the class's name."""
    found: dict[str, list[set[str]]] = {}
    for path in ROOT.glob("*_*/*_*/**/*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            # A class without a base is an event that tells of an error, not an exception.
            if isinstance(node, ast.ClassDef) and node.name.endswith("Error") and node.bases:
                bases = {base.id for base in node.bases if isinstance(base, ast.Name)}
                found.setdefault(node.name, []).append(bases)
    return found


def test_every_error_class_derives_from_the_base_class():
    classes = error_classes()
    assert len(classes) > 15

    def is_expected(name: str) -> bool:
        return name == BASE or all(
            any(base in classes and is_expected(base) for base in bases) for bases in classes[name]
        )

    assert [name for name in classes if not is_expected(name)] == []
