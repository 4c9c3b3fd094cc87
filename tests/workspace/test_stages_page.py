"""docs/stages.md and the notebook beside it show what the code does."""

from __future__ import annotations

import importlib.util
from types import ModuleType

import pytest
from readme_tables import ROOT

from rover_tools.explain.frames import FrameChoice, load_run
from rover_tools.explain.panels import STAGES
from rover_tools.explain.picture import stage_panels

PAGE = ROOT / "docs" / "stages.md"
LARGEST = 300_000  # [bytes] of the notebook


def runner() -> ModuleType:
    """docs/notebooks/run.py"""
    path = ROOT / "docs" / "notebooks" / "run.py"
    spec = importlib.util.spec_from_file_location("run_notebook", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_has_a_section_for_each_stage_in_their_order():
    headings = [line[3:] for line in PAGE.read_text().splitlines() if line.startswith("## ")]
    assert [heading.lower() for heading in headings] == [
        f"{number} {stage}" for number, stage in enumerate(STAGES, 1)
    ]


def test_the_pages_names_are_those_below_the_panels():
    pairs = stage_panels(load_run(ROOT / "docs" / "examples" / "recording", FrameChoice(0)))
    rows = [[cell.strip() for cell in line.split("|")[1:-1]]
            for line in PAGE.read_text().splitlines() if line.startswith("| ")][1:]  # fmt: skip
    names = {stage: (ours, baseline) for stage, ours, baseline in rows}
    assert names == {
        ours.stage: tuple(
            ", ".join(f"`{name}`" for name in panel.names) for panel in (ours, baseline)
        )
        for ours, baseline in pairs
    }


@pytest.fixture(scope="module")
def notebook():
    module = runner()
    cells = module.code_cells(module.read_notebook())
    return module, cells, module.run_cells(cells)


def test_the_notebook_runs_and_its_stored_text_is_what_it_gives(notebook):
    module, cells, outputs = notebook
    stored = [module.text_of(cell["outputs"]) for cell in cells]
    assert stored == [module.text_of(each) for each in outputs], "python docs/notebooks/run.py"
    assert sum(map(bool, stored)) >= 5


def test_the_notebook_shows_every_stage(notebook):
    _, cells, outputs = notebook
    sources = "".join("".join(cell["source"]) for cell in cells)
    assert all(f'pairs["{stage}"]' in sources for stage in STAGES)
    for cell, each in zip(cells, outputs, strict=True):
        stored = [output.get("data", {}).keys() for output in cell["outputs"]]
        assert stored == [output.get("data", {}).keys() for output in each]
    pictures = [o for each in outputs for o in each if "image/jpeg" in o.get("data", {})]
    assert len(pictures) == len(STAGES) / 2


def test_the_notebook_is_small():
    assert runner().NOTEBOOK.stat().st_size < LARGEST


def test_a_cell_that_fails_is_not_stored():
    module = runner()
    with pytest.raises(ZeroDivisionError):
        module.run_cells([{"source": ["x = 1\n", "x / 0"]}])
    (outputs,) = module.run_cells([{"source": ["print('a')\n", "1 + 1"]}])
    assert module.text_of(outputs) == "a\n2"
