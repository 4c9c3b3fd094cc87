"""Whatever is in a file, it is read, or refused with an error that says why."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from cases import CASES, fuzzed
from hostile_wire import changed_bytes
from hypothesis import given
from hypothesis import strategies as st
from recordings_by_hand import write_recording

from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import Maze
from rover_common.csv_table import read_table
from rover_common.errors import RoverError
from rover_common.ground_truth import load_truth
from rover_common.yaml_file import read_yaml
from rover_recorder.reader import open_recording
from rover_simulator.recordings.recording import read_recording
from rover_simulator.world.generator import generate_world
from rover_simulator.world.world import MAP_NAME, WORLD_NAME, World
from rover_tools.evaluation.parameters import read_parameters
from rover_tools.evaluation.results import load_samples

TABLE = b"x;y\n1.5;2,5\n-3;4\n"
PARAMETERS = b"decision_node:\n  ros__parameters:\n    explorer: tour\n    time_limit: 600.0\n"
LOG = (
    b"Path;SampleCount;SteerAngle;Throttle;Brake;Speed;X_Position;Y_Position;Pitch;Yaw;Roll\n"
    b"IMG/a.jpg;6;0;0.2;0;0.5;99.7;85.6;0.1;56.8;359.9\n"
    b"IMG/b.jpg;6;0;0.2;0;0.5;99.8;85.6;0.1;56.8;359.9\n"
)


def numbers(path: Path) -> list[float]:
    return [row.number(name) for row in read_table(path, ("x", "y")) for name in ("x", "y")]


def messages(path: Path) -> list[Any]:
    return list(open_recording(path).records())


@pytest.fixture(scope="module")
def files(tmp_path_factory) -> dict[str, tuple[Path, bytes, Callable[[Path], Any]]]:
    """A good file of each kind: where it lies, its content, and who reads it."""
    folder = tmp_path_factory.mktemp("files")
    generate_world(5, 0.3).save(folder / "world")
    generate_maze(3).save(folder / "maze.yaml")
    recording = write_recording(folder / "recording")
    written = {"table.csv": TABLE, "parameters.yaml": PARAMETERS, "robot_log.csv": LOG}
    for name, content in written.items():
        (folder / name).write_bytes(content)
    readers: dict[Path, Callable[[Path], Any]] = {
        folder / "table.csv": numbers,
        folder / "parameters.yaml": read_parameters,
        folder / "robot_log.csv": lambda path: read_recording(path.parent),
        folder / "maze.yaml": Maze.load,
        folder / "world" / MAP_NAME: load_truth,
        folder / "world" / WORLD_NAME: lambda path: World.load(path.parent),
    }
    found = {p.name: (p, p.read_bytes(), reader) for p, reader in readers.items()}
    samples = folder / "table.csv"
    return found | {
        "recording": (recording, recording.read_bytes(), messages),
        "samples": (samples, TABLE, load_samples),
        "yaml": (folder / "parameters.yaml", PARAMETERS, read_yaml),
    }


KINDS = (
    "table.csv", "samples", "parameters.yaml", "yaml", "robot_log.csv", "maze.yaml", MAP_NAME,
    WORLD_NAME, "recording",
)  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_a_changed_file_is_read_or_refused_with_a_reason(files, kind):
    path, content, reader = files[kind]

    @fuzzed(CASES * 0.15 / len(KINDS))
    @given(st.one_of(changed_bytes(content), st.binary(max_size=40)))
    def file_case(data: bytes) -> None:
        path.write_bytes(data)
        try:
            reader(path)
        except (RoverError, OSError) as error:
            assert str(error)

    file_case()
