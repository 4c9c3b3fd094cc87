"""The examples of the documentation are commands that run, as they are written."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

from rover_simulator.recordings.recording import read_recording
from rover_tools.cli.main import rover
from rover_tools.evaluation.results import Truth
from rover_tools.runner.graph import executable

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "docs" / "examples"
PAGES = [
    ROOT / "README.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted(ROOT.glob("*_*/README.md")),
    *sorted((ROOT / "rover_tools" / "help").glob("*.txt")),
]
COMMAND = re.compile(r"^ {2,}(?:PYTHON=\S+ |source <\()?\./rover ([^\n]*)", re.MULTILINE)
PLACEHOLDER = re.compile(r"\b(COMMAND|PACKAGE)\b")
OF_UDACITY = "map_bw.png"  # docs/scoreboard.md says where it is found
LARGEST = 2_000_000  # [bytes] of the example's files


def examples() -> Iterator[tuple[str, ...]]:
    """The words after ./rover of each command line, each once, without the launcher's own."""
    lines = (line for page in PAGES for line in COMMAND.findall(page.read_text()))
    for line in dict.fromkeys(re.split(r"\s+(?:#|>|<<)|\)(?:\s|$)", line)[0] for line in lines):
        if not PLACEHOLDER.search(line):
            yield tuple(shlex.split(re.sub(r" --platform \S+", "", line)))


LINES = list(dict.fromkeys(examples()))
OUT = {line[line.index("--out") + 1] for line in LINES if "--out" in line}
MADE = {name for name in OUT if not Path(name).suffix}  # folders that other examples make
QUICK = [words for words in LINES if words[0] in ("completion", "doctor")]


# The parts that docs/your_own_part.md makes, by the groups of their entry points
TUTORIAL = {
    "rover.explorers": "my_explorer = rover_decision.missions.sample_return.explorer:TOUR",
    "rover.recipes": "my_perception = rover_perception.recipes:BASELINE",
}


@pytest.fixture(autouse=True)
def tutorial(tmp_path, monkeypatch):
    """An environment in which the parts of the tutorial are installed."""
    info = tmp_path / "tutorial-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: tutorial\nVersion: 1.0\n")
    groups = [f"[{group}]\n{entry}\n" for group, entry in TUTORIAL.items()]
    (info / "entry_points.txt").write_text("".join(groups))
    monkeypatch.syspath_prepend(str(tmp_path))


def called(words: tuple[str, ...]) -> tuple[click.Command, list[str]]:
    """The command that the words call, and its arguments."""
    command: click.Command = rover
    rest = list(words)
    while isinstance(command, click.Group) and rest and not rest[0].startswith("-"):
        inner = command.get_command(click.Context(command), rest.pop(0))
        assert inner is not None, words
        command = inner
    return command, rest


@pytest.mark.parametrize("words", LINES, ids=" ".join)
def test_an_example_is_a_command_line_that_is_accepted(words, monkeypatch):
    monkeypatch.chdir(ROOT)
    command, arguments = called(words)
    stand_ins = {OF_UDACITY: "map.png", **dict.fromkeys(MADE, "recording")}
    arguments = [str(EXAMPLES / stand_ins[a]) if a in stand_ins else a for a in arguments]
    parent = click.Context(rover, **rover.context_settings)
    command.make_context(words[0], arguments, parent)  # raises for what cannot be used


@pytest.mark.parametrize("words", [w for w in LINES if w[0] == "run"], ids=" ".join)
def test_an_example_starts_what_is_installed(words):
    assert Path(executable(*words[1:3])).is_file()


@pytest.mark.parametrize("words", [w for w in LINES if w[0] == "test"], ids=" ".join)
def test_an_example_runs_tests_that_exist(words):
    assert all((ROOT / word).exists() for word in words if word.startswith("tests/"))


@pytest.mark.parametrize("words", QUICK, ids=" ".join)
def test_a_quick_example_runs(words, tmp_path):
    program = [sys.executable, "-m", "rover_tools.cli.main"]
    if words[0] == "doctor":
        program = [str(ROOT / "rover")]
    done = subprocess.run(
        [*program, *words],
        cwd=ROOT,
        env={**os.environ, "ROVER_RESULTS": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout


def test_every_command_has_an_example():
    commands = set(rover.list_commands(click.Context(rover)))
    assert {words[0] for words in LINES} >= commands


def test_the_example_is_a_recording_with_a_map_and_a_sample():
    recording = read_recording(EXAMPLES / "recording")
    assert (len(recording.frames), recording.skips) == (200, ())
    truth = Truth.load(EXAMPLES / "map.png", EXAMPLES / "samples.csv")
    assert truth.navigable is not None
    assert truth.samples is not None
    assert len(truth.samples) == 1
    driven = [(int(frame.pose.y), int(frame.pose.x)) for frame in recording.frames]
    assert all(truth.navigable[cell] for cell in driven)


def test_the_example_is_small():
    files = [path for path in EXAMPLES.rglob("*") if path.is_file()]
    assert sum(path.stat().st_size for path in files) < LARGEST
