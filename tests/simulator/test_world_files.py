"""Worlds from files: what nothing can drive in is refused in one line, at once."""

from __future__ import annotations

import json
import math
import signal
import subprocess
import sys

import numpy as np
import pytest
import yaml

from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import Maze, MazeError
from rover_common.errors import RoverError
from rover_common.ground_truth import TruthError
from rover_simulator.main import main
from rover_simulator.world.generator import generate_world
from rover_simulator.world.world import MAP_NAME, MOST_SAMPLES, WORLD_NAME, World, WorldError


@pytest.fixture
def folder(tmp_path):
    generate_world(5, 0.3).save(tmp_path)
    return tmp_path


def change(path, **changes):
    """In the form that JSON and YAML have in common, without aliases."""
    changed = json.dumps(yaml.safe_load(path.read_text()) | changes)
    path.write_text(changed.replace("NaN", ".nan").replace("Infinity", ".inf") + "\n")


def test_a_saved_world_is_the_same_again(folder):
    saved, read = generate_world(5, 0.3), World.load(folder)
    assert read.start == saved.start
    assert np.array_equal(read.samples, saved.samples)
    assert np.array_equal(read.navigable, saved.navigable)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"start": {"x": math.nan, "y": 100.0, "yaw": 0.0}}, "nan is no finite number"),
        ({"start": {"x": 100.0, "y": 100.0, "yaw": math.inf}}, "inf is no finite number"),
        ({"start": {"x": "nan", "y": 100.0, "yaw": 0.0}}, "no ground at the start"),
        ({"start": {"x": 1.0, "y": 1.0, "yaw": 0.0}}, "no ground at the start"),
        ({"start": {"x": -1e9, "y": 1e300, "yaw": 0.0}}, "no ground at the start"),
        ({"start": {"x": 100.0, "y": 100.0}}, "'yaw' is missing"),
        ({"start": None}, "NoneType"),
        ({"samples": [[100.0 + i / 5, 100.0] for i in range(101)]}, f"at most {MOST_SAMPLES}"),
        ({"samples": [[100.0, 101.0]] * 2}, "two samples at one place"),
        ({"samples": [[100.0, 300.0]]}, "a sample off the map"),
        ({"samples": [["inf", 1.0]]}, "a sample off the map"),
        ({"samples": [[1.0, 2.0, 3.0]]}, "too many values"),
        ({"samples": [[[1.0], 2.0]]}, "sequence"),
        ({"samples": 3}, "not iterable"),
    ],
)
def test_a_world_that_cannot_be_driven_in_is_one_line(folder, changes, reason, capsys):
    change(folder / WORLD_NAME, **changes)
    assert main(["--world", str(folder), "--time-limit", "2"]) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert WORLD_NAME in error
    assert reason in error


def test_many_samples_at_one_place_are_refused_at_once(folder):
    change(folder / WORLD_NAME, samples=[[100.0, 101.0]] * 5000)
    with pytest.raises(RoverError, match="5000 samples"):
        World.load(folder)


def test_a_world_whose_description_is_cut_anywhere_is_refused(folder):
    whole = (folder / WORLD_NAME).read_bytes()
    for length in range(len(whole)):
        (folder / WORLD_NAME).write_bytes(whole[:length])
        with pytest.raises(WorldError, match=WORLD_NAME):
            World.load(folder)


def test_a_world_whose_map_is_cut_is_refused_unless_all_of_it_is_there(folder):
    saved, whole = generate_world(5, 0.3), (folder / MAP_NAME).read_bytes()
    for length in {*range(0, len(whole), 7), len(whole) - 1}:
        (folder / MAP_NAME).write_bytes(whole[:length])
        try:
            read = World.load(folder)
        except TruthError:
            continue
        assert np.array_equal(read.navigable, saved.navigable)
        assert length > len(whole) - 30  # the marks of the end


def test_a_maze_that_is_cut_anywhere_is_refused(tmp_path):
    path = tmp_path / "maze.yaml"
    maze = generate_maze(3, "challenge")
    maze.save(path)
    assert Maze.load(path) == maze
    whole = path.read_bytes()
    lengths = {*range(0, len(whole), 61), *(i for i, c in enumerate(whole) if c == ord("\n"))}
    for length in lengths:  # also where a line ends
        path.write_bytes(whole[:length])
        with pytest.raises(MazeError, match=r"maze\.yaml"):
            Maze.load(path)


@pytest.mark.parametrize(
    ("key", "value", "reason"),
    [
        ("width", math.nan, "no finite number"),
        ("width", 1e9, "at most 50 m"),
        ("walls", [[0, 0, 1, 1]] * 1001, "1001 walls"),
        ("walls", [[0, 0, 1]], "y1"),
        ("sources", [{"x": 1}], "missing"),
        ("sources", ["a"], "indices"),
        ("start", {"x": -1, "y": 0, "yaw": 0, "pitch": 0, "roll": 0}, "off the field"),
        ("errors", None, "subscriptable"),
        ("air", "cold", "cold"),
    ],
)
def test_a_maze_that_cannot_be_driven_in_is_refused(tmp_path, key, value, reason):
    path = tmp_path / "maze.yaml"
    generate_maze(3, "demo").save(path)
    change(path, **{key: value})
    with pytest.raises(MazeError, match=reason):
        Maze.load(path)


def test_a_second_signal_ends_a_simulator_that_does_not_listen():
    code = (
        "from rover_simulator.run import Stop\n"
        "stop = Stop()\n"
        "print('ready', flush=True)\n"
        "while not stop(): pass\n"
        "print('asked', flush=True)\n"
        "while True: pass\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    for line in ("ready\n", "asked\n"):
        assert process.stdout.readline() == line
        process.terminate()
    assert process.wait(30) == -signal.SIGTERM
