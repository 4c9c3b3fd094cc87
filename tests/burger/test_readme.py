"""The README is the simulator's contract: its tables say what the program says."""

from __future__ import annotations

from dataclasses import fields

from readme_tables import ROOT, table

from burger_simulator.options import BurgerOptions
from burger_simulator.truth import Truth
from burger_simulator.world.families import FAMILIES

README = ROOT / "burger_simulator" / "README.md"


def test_each_option_is_described_with_its_default():
    rows = table(README, "Options")
    assert [row["option"] for row in rows] == [field.name for field in fields(BurgerOptions)]
    for row, field in zip(rows, fields(BurgerOptions), strict=True):
        default = field.default
        rounded = round(default, 4) if isinstance(default, float) else default
        assert row["default"] == str(rounded)
        assert row["meaning"] == field.metadata["parameter"].description


def test_each_member_of_the_truth_is_described():
    names = [
        name.strip("` ") for row in table(README, "Truth") for name in row["member"].split(",")
    ]
    assert names == [field.name for field in fields(Truth)]


def test_the_families_are_those_that_are_drawn():
    rows = table(README, "Families of mazes")
    for row in rows:
        family = FAMILIES[row["family"]]
        fewest, most = family.sources
        assert row["width"] == str(family.width)
        assert row["height"] == str(family.height)
        assert row["ramp"] == ("yes" if family.ramp else "no")
        assert row["sources"] == (str(fewest) if fewest == most else f"{fewest} to {most}")
        assert row["source at the ramp"] == str(family.ramp_source)
    assert [row["family"] for row in rows] == list(FAMILIES)
