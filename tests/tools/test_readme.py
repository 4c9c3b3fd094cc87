"""The README is the package's contract: its tables say what the commands say."""

from __future__ import annotations

from pathlib import Path

import click
import pytest

from rover_tools.cli.bench import group as bench
from rover_tools.cli.heat import group as heat
from rover_tools.cli.main import TABLE, rover

README = Path(__file__).resolve().parents[2] / "rover_tools" / "README.md"
GROUPS = {"bench": bench.TABLE, "heat": heat.TABLE}
ELSEWHERE = {"sim"}  # rover_simulator's README has its options


def table(heading: str) -> list[list[str]]:
    section = README.read_text().split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]
    rows = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in rows[2:]]


def entries() -> dict[str, str]:
    """What the lists of commands say, by `mission` or `bench graph`."""
    inner = {
        f"{group} {name}": entry.summary
        for group, table in GROUPS.items()
        for name, entry in table.items()
    }
    outer = {name: entry.summary for name, entry in TABLE.items() if name not in GROUPS}
    return outer | inner


def options() -> dict[str, list[tuple[str, click.Parameter]]]:
    """Commands and their parameters, by the option's names as the README writes them."""
    found: dict[str, list[tuple[str, click.Parameter]]] = {}
    for name in entries():
        command: click.Command = rover
        for word in name.split():
            assert isinstance(command, click.Group)
            inner = command.get_command(click.Context(command), word)
            assert inner is not None
            command = inner
        for parameter in command.params:
            if isinstance(parameter, click.Option) and name not in ELSEWHERE:
                names = ", ".join(f"`{option}`" for option in parameter.opts)
                found.setdefault(names, []).append((name, parameter))
    return found


def test_the_commands_are_those_of_the_groups():
    assert {row[0].strip("`"): row[1] for row in table("Commands")} == entries()


def test_each_option_is_in_the_table_and_the_other_way_round():
    rows = table("Options")
    assert len(rows) == len(options())
    assert {row[0] for row in rows} == set(options())


@pytest.mark.parametrize("names", options())
def test_an_option_has_its_commands_and_their_defaults(names):
    (row,) = [row for row in table("Options") if row[0] == names]
    uses = options()[names]
    assert {name.strip(" `") for name in row[3].split(",")} == {name for name, _ in uses}
    values = {
        name: parameter.default for name, parameter in uses if isinstance(parameter.default, str)
        or type(parameter.default) in (int, float)
    }  # fmt: skip
    for name, default in values.items():
        assert f"`{default}`" in row[2], name
        if f"`{name}`: " in row[2]:
            assert f"`{name}`: `{default}`" in row[2]
