"""docs/from_the_original.md names parameters, topics and pages that exist."""

from __future__ import annotations

import re

import pytest
import yaml
from readme_tables import ROOT

from rover_common import topics

PAGE = ROOT / "docs" / "from_the_original.md"
OF_THE_ORIGINAL = {
    "throttle_set", "brake_set", "max_vel", "stop_forward", "go_forward", "stop_side",
    "left_right_ratio", "rock_collect_threshold",
}  # fmt: skip


def rows(heading: str) -> list[list[str]]:
    """The cells of a section's table."""
    section = PAGE.read_text().split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def names_in(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


def parameters() -> set[str]:
    sections = yaml.safe_load((ROOT / "rover_bringup" / "config" / "rover.yaml").read_text())
    return {name for section in sections.values() for name in section["ros__parameters"]}


def test_every_setting_of_the_original_has_its_row():
    named = {name for row in rows("Settings") for name in names_in(row[0])}
    assert named >= OF_THE_ORIGINAL


def test_each_parameter_named_is_one_of_rover_yaml():
    named = [name for row in rows("Settings") for name in names_in(row[2])]
    assert len(named) >= 12
    assert set(named) <= parameters()


def test_each_topic_named_is_one_of_the_graph():
    named = [name for row in rows("State and results") for name in names_in(row[1])]
    assert len(named) >= 9
    assert set(named) <= {value for name, value in vars(topics).items() if name.isupper()}


@pytest.mark.parametrize(
    ("heading", "folder"),
    [
        ("perception_step()", "rover_perception/rover_perception"),
        ("decision_step()", "rover_decision/rover_decision/missions/sample_return"),
    ],
)
def test_each_module_named_is_there(heading, folder):
    cells = [cell for row in rows(heading) for cell in row[1:]]
    named = [name for cell in cells for name in names_in(cell) if name.endswith(".py")]
    assert len(named) >= 12
    assert [name for name in named if not (ROOT / folder / name).is_file()] == []


def test_the_simulator_is_named_without_a_link():
    section = PAGE.read_text().split("## The Unity simulator\n", 1)[1]
    assert "http" not in section
    assert "1024 x 768" in section
    assert "*Good*" in section
