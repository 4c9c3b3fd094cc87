"""What the code uses of its libraries, by name, is in the versions that are installed here."""

from __future__ import annotations

import ast
import contextlib
import functools
import importlib
import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {path.parent.name for path in ROOT.glob("*/package.xml")}
MODULES = sorted(path for name in PACKAGES for path in (ROOT / name / name).rglob("*.py"))
LIBRARIES = {
    "PIL", "aiohttp", "av", "click", "cv2", "dask", "distributed", "embreex", "engineio",
    "eventlet", "jinja2", "matplotlib", "mcap", "mujoco", "networkx", "numpy", "rclpy", "scipy",
    "skimage", "socketio", "statemachine", "tabulate", "tqdm", "websocket", "yaml", "zstandard",
}  # fmt: skip


@functools.cache
def found(path: str) -> Any:
    """What a dotted name means; raises AttributeError or ImportError."""
    if "." not in path:
        return importlib.import_module(path)
    before, _, name = path.rpartition(".")
    outer = found(before)
    with contextlib.suppress(ImportError, TypeError):
        if inspect.ismodule(outer):  # a module comes before a function of its name
            return importlib.import_module(path)
    return getattr(outer, name)


def imported_names(tree: ast.Module) -> dict[str, str]:
    """The dotted name of each name that an import of a library binds."""
    bound: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name.split(".")[0] in LIBRARIES:
                    first = alias.name.split(".")[0]
                    bound |= {alias.asname: alias.name} if alias.asname else {first: first}
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in LIBRARIES:
            bound |= {a.asname or a.name: f"{node.module}.{a.name}" for a in node.names}
    return bound


def dotted(node: ast.expr, bound: dict[str, str]) -> str | None:
    """The dotted name that an expression spells, if it begins with an imported one."""
    if isinstance(node, ast.Name):
        return bound.get(node.id)
    if isinstance(node, ast.Attribute):
        before = dotted(node.value, bound)
        return None if before is None else f"{before}.{node.attr}"
    return None


def uses(tree: ast.Module) -> Iterator[tuple[str, set[str]]]:
    """Each dotted name, and the keywords of its call."""
    bound = imported_names(tree)
    for name in bound.values():
        yield name, set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and (name := dotted(node, bound)):
            yield name, set()
        elif isinstance(node, ast.Call) and (name := dotted(node.func, bound)):
            yield name, {each.arg for each in node.keywords if each.arg}


def unknown_keywords(function: Any, keywords: set[str]) -> set[str]:
    """Those that the function does not take, as far as it can be asked."""
    try:
        parameters = inspect.signature(function).parameters
    except (TypeError, ValueError):
        return set()  # compiled
    if any(each.kind is each.VAR_KEYWORD for each in parameters.values()):
        return set()
    return keywords - set(parameters)


@pytest.mark.parametrize("path", MODULES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_the_libraries_have_what_is_used_of_them(path):
    tree = ast.parse(path.read_text())
    for name, keywords in uses(tree):
        assert not unknown_keywords(found(name), keywords), name


def test_a_name_that_is_missing_is_found():
    tree = ast.parse("import cv2 as c\nfrom scipy import ndimage as n\nn.label(c.NO_SUCH, sauce=1)")
    assert ("scipy.ndimage.label", {"sauce"}) in list(uses(tree))
    assert unknown_keywords(found("scipy.ndimage.label"), {"sauce"}) == {"sauce"}
    with pytest.raises(AttributeError):
        found("cv2.NO_SUCH")
