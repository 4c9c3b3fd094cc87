"""A package made by `rover new` is known to every command at once, and its test passes."""

from __future__ import annotations

import json
import subprocess
import sys
import sysconfig
import venv
from importlib.util import find_spec
from pathlib import Path

import pytest

from rover_common.registry import PartError
from rover_decision.missions.sample_return.explorer import explorer_of
from rover_perception.factory import recipe_of
from rover_tools.cli.main import main
from rover_tools.new_part.kinds import KINDS, NewPartError, install

ROOT = Path(__file__).resolve().parents[2]
PARTS = {"explorer": "sandy_explorer", "perception": "sandy_perception"}


class Environment:
    """An environment of its own over the one of the tests, so that nothing is left behind."""

    def __init__(self, folder: Path) -> None:
        venv.create(folder / "venv", with_pip=False)
        self.folder = folder
        self._python = folder / "venv" / "bin" / "python"
        site = sysconfig.get_path("purelib", vars={"base": str(folder / "venv")})
        there = [path for path in sys.path if path.endswith("-packages")]
        (Path(site) / "below.pth").write_text("\n".join(there) + "\n")

    def run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """`python -m ARGUMENTS` in the folder."""
        return subprocess.run(
            [self._python, "-m", *arguments], cwd=self.folder, capture_output=True, text=True
        )

    def rover(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        return self.run("rover_tools.cli.main", *arguments)


@pytest.fixture(scope="module")
def environment(tmp_path_factory) -> Environment:
    """With a part of each kind."""
    environment = Environment(tmp_path_factory.mktemp("parts"))
    for kind, name in PARTS.items():
        made = environment.rover("new", kind, name)
        assert made.returncode == 0, made.stderr
        assert f"./rover test {name}" in made.stdout
    return environment


@pytest.mark.parametrize("name", PARTS.values())
def test_its_own_test_passes(environment, name):
    done = environment.run("pytest", "-q", "-p", "no:cacheprovider", name)
    assert done.returncode == 0, done.stdout


def test_the_scoreboard_has_its_row(environment):
    names = PARTS["explorer"], f"tour@{PARTS['perception']}"
    short = ["--worlds", "1", "--size", "0.2", "--fps", "5", "--time-limit", "10"]
    arguments = ["--strategies", ",".join(names), "--out", "board", "--workers", "1", "--json"]
    done = environment.rover("scoreboard", *short, *arguments)
    assert done.returncode == 0, done.stderr
    rows = json.loads(done.stdout)
    assert {row["strategy"] for row in rows} == set(names)
    assert all(row["percent_mapped"] > 0 for row in rows)


def test_an_error_in_a_rule_is_a_failed_mission_and_told(environment):
    file = environment.folder / PARTS["explorer"] / "src" / PARTS["explorer"] / "explorer.py"
    text = file.read_text()
    head, rule, rest = text.partition("    if goal.kind is")
    assert rule
    try:
        file.write_text(f'{head}    raise ValueError("ups")\n{rule}{rest}')
        short = ["--worlds", "1", "--size", "0.2", "--fps", "5", "--time-limit", "10"]
        done = environment.rover(
            "scoreboard", *short, "--strategies", PARTS["explorer"], "--out", "broken",
            "--workers", "1", "--json",
        )  # fmt: skip
    finally:
        file.write_text(text)
    assert done.returncode == 1
    (row,) = json.loads(done.stdout)
    assert row["reason"].startswith("failed: PlanError: the planner failed: ValueError: ups (")
    assert "explorer.py:" in row["reason"]


def test_a_second_one_of_this_name_is_refused(environment):
    again = environment.rover("new", "explorer", PARTS["explorer"], "--out", "elsewhere")
    assert again.returncode == 1
    assert again.stderr == (
        "rover new: there is explorer 'sandy_explorer' already; choose another name\n"
    )


@pytest.mark.skipif(find_spec("ruff") is None, reason="the lint tools are on the other platform")
def test_its_files_keep_the_projects_style(environment):
    for check in (["check"], ["format", "--check"]):
        config = ["--config", str(ROOT / "pyproject.toml")]
        done = environment.run("ruff", *check, *config, *PARTS.values())
        assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("9lives", "'9lives' is no name; write up to 40 lower-case letters"),
        ("Sandy", "'Sandy' is no name"),
        ("a-b", "'a-b' is no name"),
        ("../up", "'../up' is no name"),
        ("a" * 41, "is no name"),
        ("class", "'class' is no name"),
        ("tour", "there is explorer 'tour' already"),
        ("json", "there is a Python package 'json' already"),
    ],
)
def test_a_name_that_cannot_be_used_is_refused_in_one_line(name, said, capsys, tmp_path):
    folder = tmp_path / "part"
    assert main(["new", "explorer", name, "--out", str(folder)]) == 1
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert not folder.exists()


def test_a_folder_that_is_there_stays_as_it_is(capsys, tmp_path):
    (tmp_path / "mine").mkdir()
    assert main(["new", "explorer", "sandy", "--out", str(tmp_path / "mine")]) == 1
    assert "is there already; choose another name or --out" in capsys.readouterr().err
    assert list((tmp_path / "mine").iterdir()) == []


def test_what_cannot_be_installed_is_not_left_behind(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "executable", "/bin/false")
    assert main(["new", "explorer", "sandy", "--out", str(tmp_path / "mine")]) == 1
    assert "pip cannot install" in capsys.readouterr().err
    assert not (tmp_path / "mine").exists()


def test_the_cause_is_told_why_it_cannot_be_installed(tmp_path):
    (tmp_path / "setup.py").write_text("raise OSError('the moon is full')\n")
    with pytest.raises(NewPartError, match=r"OSError: the moon is full$"):
        install(tmp_path)


@pytest.mark.parametrize("kind", KINDS.values(), ids=list(KINDS))
def test_every_own_part_can_be_loaded(kind):
    load = {"explorer": explorer_of, "recipe": recipe_of}[kind.registry.kind]
    for name in kind.registry.own:
        load(name)
    with pytest.raises(PartError, match=f"no {kind.registry.kind} 'gone'; there are"):
        load("gone")
