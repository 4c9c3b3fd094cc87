"""Files of parameters, and the tables that say what they mean."""

from __future__ import annotations

import math
from dataclasses import fields, replace

import pytest
from readme_tables import ROOT, column, table

from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_heat.node_config import HeatNodeConfig
from rover_heat.presets import PresetError, load_preset

FOLDER = ROOT / "rover_bringup" / "config"
README = ROOT / "rover_heat" / "README.md"


def test_the_default_preset_is_the_defaults():
    assert load_preset(FOLDER / "heat.yaml") == HeatConfig()


def test_the_reference_differs_where_it_is_said_to():
    reference = load_preset(FOLDER / "reference.yaml")
    assert (reference.heat_bearing, reference.heat_rule) == ("axis", "absolute")
    assert (reference.clustering, reference.clusters) == ("kmeans", 3)
    assert (reference.imu_threshold, reference.imu_abs_threshold) == (5.0, 0.16)
    assert reference.fast_explore


def test_the_page_looks_ahead_to_both_sides():
    page = load_preset(FOLDER / "page.yaml")
    yaws = math.radians(30.0), math.radians(-30.0)
    assert (page.thermal_yaw_1, page.thermal_yaw_2) == pytest.approx(yaws, abs=1e-3)
    assert replace(page, thermal_yaw_1=1.5184, thermal_yaw_2=0.0) == HeatConfig()


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("payloads: 4.5", "int"),
        ("stand_off: near", "float"),
        ("stand_off: 5.0", "within"),
        ("heat_rule: warm", "one of"),
        ("no_such: 1", "no parameter"),
        ("use_padding: 1", "bool"),
    ],
)
def test_what_a_preset_cannot_ask_for_is_refused(tmp_path, line, problem):
    path = tmp_path / "preset.yaml"
    path.write_text(f"/**/heat_node:\n  ros__parameters:\n    {line}\n")
    with pytest.raises(PresetError, match=problem):
        load_preset(path)


def test_a_preset_may_say_how_the_node_is_connected(tmp_path):
    path = tmp_path / "preset.yaml"
    path.write_text('/**/heat_node:\n  ros__parameters:\n    state_dir: ""\n    payloads: 2\n')
    assert load_preset(path) == HeatConfig(payloads=2)


@pytest.mark.parametrize("text", ["", "[]", "/**/other:\n  ros__parameters: {}\n", "{"])
def test_a_file_that_is_no_preset_is_refused(tmp_path, text):
    path = tmp_path / "preset.yaml"
    path.write_text(text)
    with pytest.raises(PresetError):
        load_preset(path)
    with pytest.raises(PresetError):
        load_preset(tmp_path / "none.yaml")


def test_the_readme_lists_every_parameter():
    rows = table(README, "Parameters")
    assert [row["parameter"] for row in rows] == [field.name for field in fields(HeatNodeConfig)]
    for row, field in zip(rows, fields(HeatNodeConfig), strict=True):
        info = field.metadata["parameter"]
        limits = "" if info.minimum is None else f"{info.minimum} to {info.maximum}"
        switch = "False, True" if isinstance(field.default, bool) else limits
        wanted = ", ".join(info.choices) or switch
        assert row["default"] == str(field.default), field.name
        assert row["range"].replace("`", "") == wanted, field.name


def test_the_readme_lists_every_state():
    rows = [name.strip("`, ") for cell in column(README, "The mission", "state")
            for name in cell.split(",")]  # fmt: skip
    assert set(rows) == {state.name for state in State}


def test_the_readme_names_every_module():
    folder = ROOT / "rover_heat" / "rover_heat"
    text = README.read_text()
    aside = {"__init__.py", "types.py", "config.py", "mission.py", "tick.py"}
    modules = {path.name for path in folder.rglob("*.py") if "states" not in path.parts} - aside
    assert {name for name in modules if name in text} == modules
