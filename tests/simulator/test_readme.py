"""The README is the simulator's contract: its tables say what the program says."""

from __future__ import annotations

from dataclasses import fields
from itertools import takewhile
from pathlib import Path

import click
import pytest
from telemetry import telemetry

from rover_simulator.config import SimulatorConfig
from rover_simulator.main import command
from rover_simulator.wire.unity_client import ANSWERED_EVENTS

README = Path(__file__).resolve().parents[2] / "rover_simulator" / "README.md"
NO_DEFAULT = {"none": None, "off": False}


def table(heading: str, first: str) -> list[list[str]]:
    """The rows below a heading, of the table whose first column has this name."""
    section = README.read_text().split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = section[section.index(f"| {first} |") :].splitlines()
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in takewhile(lambda line: line.startswith("|"), lines)
    ]
    return rows[2:]


def options() -> dict[str, click.Parameter]:
    return {parameter.opts[-1]: parameter for parameter in command.params}


def test_each_option_is_in_the_table_and_the_other_way_round():
    rows = table("Options of `rover sim`", "option")
    assert [row[0].strip("`") for row in rows] == list(options())


@pytest.mark.parametrize("name", options())
def test_each_default_is_the_programs(name):
    (row,) = [row for row in table("Options of `rover sim`", "option") if row[0] == f"`{name}`"]
    written, parameter = row[2], options()[name]
    if written in NO_DEFAULT:
        values = command.make_context("sim", []).params
        assert values[parameter.name] == NO_DEFAULT[written]
    else:
        assert written == f"`{parameter.default}`"


def test_the_telemetrys_keys_are_those_sent_in_their_order():
    rows = table("Telemetry", "key")
    assert [row[0].strip("`") for row in rows] == list(telemetry(sim_time=1.0, shows_insets=True))


def test_the_events_are_those_that_are_answered():
    rows = table("What it accepts", "event")
    answered = {row[0].strip("`") for row in rows if row[2] == "yes"}
    assert answered == ANSWERED_EVENTS


def test_the_parameters_of_the_node_are_those_of_its_configuration():
    rows = table("Options of `rover sim`", "parameter")
    assert [row[0].strip("`") for row in rows] == [field.name for field in fields(SimulatorConfig)]
    for row, field in zip(rows, fields(SimulatorConfig), strict=True):
        assert row[2].strip("`") == (str(field.default) or "none")
