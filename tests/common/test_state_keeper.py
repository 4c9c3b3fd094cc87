"""States are saved beside the work: when one is due, the newest, and the last one at the end."""

from __future__ import annotations

import threading

import pytest

from rover_common.saved_state import SavedState, StateFile
from rover_common.state_keeper import MakeState, StateKeeper
from rover_common.types import FIRST_RUN

LONG = 1e9  # [s] no second copy is due


class Snapshots:
    """Numbered states, with the names of the threads that make them."""

    def __init__(self) -> None:
        self.taken = 0
        self.makers: list[str] = []
        self.gate = threading.Event()
        self.gate.set()

    def __call__(self) -> MakeState:
        self.taken += 1
        number = self.taken

        def make() -> SavedState:
            self.gate.wait()
            self.makers.append(threading.current_thread().name)
            return SavedState(FIRST_RUN, number, {})

        return make


@pytest.fixture
def file(tmp_path) -> StateFile:
    return StateFile(tmp_path / "node.state", "test", 1)


@pytest.fixture
def warnings() -> list[str]:
    return []


def newest(file: StateFile) -> int:
    return file.read()[0][0].stamp


def test_only_a_state_that_is_due_is_taken(file, warnings):
    keeper, snapshots = StateKeeper(file, warnings.append, LONG), Snapshots()
    for _ in range(5):
        keeper.keep(snapshots)
    keeper.close()
    assert snapshots.taken == newest(file) == 1
    assert snapshots.makers != [threading.current_thread().name]


def test_what_is_kept_first_is_written_before_anything_else_is_done(file, warnings):
    keeper, snapshots = StateKeeper(file, warnings.append, LONG), Snapshots()
    keeper.keep(snapshots)
    keeper.keep_first(snapshots)
    assert newest(file) == 2
    keeper.close()


def test_a_disk_that_hangs_holds_up_what_is_kept_first_for_some_time_only(file, warnings):
    keeper, snapshots = StateKeeper(file, warnings.append, LONG), Snapshots()
    snapshots.gate.clear()
    keeper.keep_first(snapshots, seconds=0.05)
    assert file.read() == ([], [])
    snapshots.gate.set()
    keeper.close()
    assert newest(file) == 1


def test_what_must_not_be_forgotten_is_saved_at_once(file, warnings):
    keeper, snapshots = StateKeeper(file, warnings.append, LONG), Snapshots()
    snapshots.gate.clear()
    keeper.keep(snapshots)
    keeper.keep(snapshots, at_once=True)  # the first one is being written
    snapshots.gate.set()
    while snapshots.taken < 2:
        keeper.keep(snapshots)
    keeper.close()
    assert newest(file) == 2


def test_while_one_is_being_written_no_other_is_taken(file, warnings):
    keeper, snapshots = StateKeeper(file, warnings.append, 0.0), Snapshots()
    snapshots.gate.clear()
    for _ in range(5):
        keeper.keep(snapshots)
    assert snapshots.taken == 1
    snapshots.gate.set()
    keeper.close()


def test_the_last_state_is_saved_at_the_end(file, warnings):
    keeper, snapshots = StateKeeper(file, warnings.append, LONG), Snapshots()
    keeper.keep(snapshots)
    keeper.close(snapshots)
    assert newest(file) == 2


def test_a_folder_that_cannot_be_written_is_one_warning(tmp_path, warnings):
    (tmp_path / "file").write_text("")
    keeper = StateKeeper(StateFile(tmp_path / "file" / "a", "test", 1), warnings.append, 0.0)
    snapshots = Snapshots()
    while snapshots.taken < 3:
        keeper.keep(snapshots)
    keeper.close()
    assert len(warnings) == 1
    assert "cannot be saved" in warnings[0]
