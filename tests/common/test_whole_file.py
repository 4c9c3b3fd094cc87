"""Results are whole or not there, also when the disk is full."""

import errno
import json
import resource
from contextlib import contextmanager

import numpy as np
import pytest

from rover_common.types import GridMap
from rover_common.whole_file import whole_file, write_whole
from rover_simulator.world.generator import generate_world
from rover_tools.evaluation.results import Truth, write_results


@contextmanager
def full_disk(size: int):
    """No file grows beyond this size [bytes]: a write fails as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_file_has_its_content(tmp_path):
    write_whole(tmp_path / "a", "größer")
    write_whole(tmp_path / "a", b"new")
    assert (tmp_path / "a").read_bytes() == b"new"
    assert names(tmp_path) == ["a"]


def test_a_full_disk_leaves_the_older_file_and_nothing_else(tmp_path):
    write_whole(tmp_path / "result.json", "old")
    with full_disk(1000), pytest.raises(OSError) as caught:
        write_whole(tmp_path / "result.json", "x" * 2000)
    assert caught.value.errno == errno.EFBIG
    assert caught.value.filename == str(tmp_path / "result.json")
    assert (tmp_path / "result.json").read_text() == "old"
    assert names(tmp_path) == ["result.json"]


def test_an_error_of_the_writer_leaves_nothing(tmp_path):
    with pytest.raises(ZeroDivisionError), whole_file(tmp_path / "a") as draft:
        draft.write_text("half")
        raise ZeroDivisionError
    assert names(tmp_path) == []


@pytest.mark.parametrize("size", [0, 100, 20_000])
def test_a_result_folder_on_a_full_disk_is_an_error_and_has_no_part_of_a_file(tmp_path, size):
    grid = GridMap(1.0, 0.0, 0.0, np.zeros((200, 200), np.int8))
    result = {"frames": 2, "notes": "x" * 200}
    with full_disk(size), pytest.raises(OSError):
        write_results(tmp_path, result, grid, np.ones((2, 2)), (), Truth(), "a run")
    for path in tmp_path.iterdir():  # those that fitted
        assert path.name in ("result.json", "worldmap.yaml")
        assert path.name != "result.json" or json.loads(path.read_text()) == result


def test_a_world_on_a_full_disk_is_an_error(tmp_path):
    with full_disk(50), pytest.raises(OSError, match=r"map\.png"):
        generate_world(5, 0.3).save(tmp_path)
    assert names(tmp_path) == []
