"""A saved state is read as it was written, or refused as a whole."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_common.saved_state import SavedState, StateFile
from rover_common.types import Run

RUN = Run(3, 1_040_000_000)
STATE = SavedState(
    RUN,
    5_000_000_000,
    {"home": [99.67, 85.589], "until": [float("inf"), 3.5], "name": "Rover \u00e9"},
    {"points": np.arange(12, dtype=np.float64).reshape(6, 2), "none": np.empty((0, 3), np.float32)},
)
OTHER = SavedState(RUN, 6_000_000_000, {"home": [1.0, 2.0]})


@pytest.fixture
def file(tmp_path) -> StateFile:
    return StateFile(tmp_path / "folder" / "node.state", "test", 2)


def assert_same(one: SavedState, other: SavedState) -> None:
    assert (one.run, one.stamp, one.values) == (other.run, other.stamp, other.values)
    assert one.arrays.keys() == other.arrays.keys()
    for name, array in one.arrays.items():
        assert array.dtype == other.arrays[name].dtype
        assert np.array_equal(array, other.arrays[name])


def test_what_is_written_is_read(file):
    file.write(STATE)
    (state,), refusals = file.read()
    assert_same(state, STATE)
    assert refusals == []


def test_where_nothing_was_written_nothing_is_found_or_refused(file):
    assert file.read() == ([], [])


def test_the_state_before_stays_as_the_older_copy(file):
    file.write(STATE)
    file.write(OTHER)
    (newest, older), _ = file.read()
    assert_same(newest, OTHER)
    assert_same(older, STATE)
    assert {path.name for path in file.path.parent.iterdir()} == {"node.state", "node.state.old"}


def test_a_torn_file_is_refused_in_one_line_and_the_older_copy_is_left(file):
    file.write(STATE)
    file.write(OTHER)
    file.path.write_bytes(file.path.read_bytes()[:-5])
    (state,), (refusal,) = file.read()
    assert_same(state, STATE)
    assert str(file.path) in refusal
    assert "\n" not in refusal


@pytest.mark.parametrize("kind, version", [("test", 1), ("test", 3), ("another", 2)])
def test_another_kind_or_version_is_refused(file, kind, version):
    StateFile(file.path, kind, version).write(STATE)
    states, (refusal,) = file.read()
    assert states == []
    assert kind in refusal


@given(st.data())
def test_a_file_that_is_cut_or_changed_anywhere_is_refused_or_the_same(tmp_path_factory, data):
    file = StateFile(tmp_path_factory.mktemp("state") / "node.state", "test", 2)
    file.write(STATE)
    content = bytearray(file.path.read_bytes())
    place = data.draw(st.integers(0, len(content) - 1))
    if data.draw(st.booleans()):
        del content[place:]
    else:
        content[place] ^= data.draw(st.integers(1, 255))
    file.path.write_bytes(content)
    states, refusals = file.read()
    assert len(states) + len(refusals) == 1
    for state in states:
        assert_same(state, STATE)


@given(st.binary(max_size=200))
def test_whatever_else_is_in_the_file_is_refused(tmp_path_factory, content):
    file = StateFile(tmp_path_factory.mktemp("state") / "node.state", "test", 2)
    file.path.write_bytes(content)
    states, refusals = file.read()
    assert (states, len(refusals)) == ([], 1)


def test_a_state_that_cannot_be_written_leaves_the_one_before(file):
    file.write(STATE)
    with pytest.raises(TypeError):
        file.write(SavedState(RUN, 7, {"no": object()}))
    (state,), _ = file.read()
    assert_same(state, STATE)


def test_a_state_continues_with_later_frames_of_its_run_alone():
    assert STATE.continues_with(RUN, STATE.stamp)
    assert STATE.continues_with(RUN, STATE.stamp + 1)
    assert not STATE.continues_with(RUN, STATE.stamp - 1)  # stamps never fall back within a run
    assert not STATE.continues_with(Run(4, RUN.start), STATE.stamp)
    assert not STATE.continues_with(Run(3, RUN.start + 1), STATE.stamp)
