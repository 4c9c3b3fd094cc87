"""Parts by their names: own ones, and those that installed packages add."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from rover_common.registry import PartError, Registry

GROUP = "rover.test_parts"
MODULE = "number = 3\ntext = 'three'\n"


def add_package(folder: Path, package: str, entries: str, module: str = MODULE) -> None:
    """A module, and the metadata of a package that holds it, as an installer writes them."""
    (folder / f"{package}.py").write_text(module)
    info = folder / f"{package}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[{GROUP}]\n{entries}")


@pytest.fixture
def site(tmp_path, monkeypatch) -> Path:
    """A folder of installed packages."""
    monkeypatch.syspath_prepend(str(tmp_path))
    return tmp_path


@pytest.fixture
def registry() -> Registry:
    return Registry("part", GROUP, {"pi": "math:pi", "e": "math:e"})


def test_own_names_come_first_and_in_their_order(registry, site):
    add_package(site, "b_part", "b = b_part:number\na = b_part:number\n")
    assert list(registry) == ["pi", "e", "a", "b"]
    assert registry.own == ("pi", "e")
    assert len(registry) == 4
    assert "a" in registry
    assert "c" not in registry
    assert ["a"] not in registry  # what a page or a file sends is of any type


def test_a_part_is_imported_when_it_is_asked_for(registry, site):
    add_package(site, "late_part", "late = late_part:number\n")
    assert "late" in list(registry)
    assert "late_part" not in sys.modules
    assert registry.load("late", int) == 3
    assert registry.load("pi", float) == pytest.approx(3.14159)


def test_an_own_name_cannot_be_taken(registry, site):
    add_package(site, "other_pi", "pi = other_pi:number\n")
    assert registry.load("pi", float) == pytest.approx(3.14159)
    assert list(registry) == ["pi", "e"]


@pytest.mark.parametrize(
    ("entry", "module", "said"),
    [
        ("x = bad_part:gone\n", MODULE, "part 'x', bad_part:gone: AttributeError: "),
        ("x = bad_part:number\n", "1 / 0\n", "part 'x', bad_part:number: ZeroDivisionError: "),
        ("x = no_such_module:part\n", MODULE, "ModuleNotFoundError: No module named"),
        ("x = bad_part:text\n", MODULE, "part 'x', bad_part:text: is no int, but a str"),
        ("y = bad_part:number\n", MODULE, "no part 'x'; there are pi, e, y"),
    ],
)
def test_what_is_no_part_is_told_in_one_line(registry, site, monkeypatch, entry, module, said):
    monkeypatch.delitem(sys.modules, "bad_part", raising=False)
    add_package(site, "bad_part", entry, module)
    with pytest.raises(PartError) as error:
        registry.load("x", int)
    assert said in str(error.value)
    assert "\n" not in str(error.value)
