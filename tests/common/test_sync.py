"""The exact time synchronizer joins messages of one stamp."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_common.ros.sync import ExactTimeSynchronizer

SOURCES = ("a", "b", "c")


def test_a_set_is_complete_with_a_message_of_every_source():
    sync = ExactTimeSynchronizer(("a", "b"))
    assert sync.add("a", 1, "A") is None
    assert sync.add("b", 2, "other") is None
    assert sync.add("b", 1, "B") == {"a": "A", "b": "B"}
    assert sync.add("b", 1, "B") is None  # it was given already


def test_a_source_that_was_not_named_is_refused():
    with pytest.raises(KeyError):
        ExactTimeSynchronizer(("a", "b")).add("c", 1, "C")


def test_the_oldest_incomplete_set_is_dropped():
    sync = ExactTimeSynchronizer(("a", "b"), queue_size=2)
    for stamp in range(5):
        sync.add("a", stamp, stamp)
    assert sync.dropped == 3
    assert sync.add("b", 0, 0) is None
    assert sync.add("b", 4, 4) == {"a": 4, "b": 4}


def test_clearing_forgets_all_incomplete_sets():
    sync = ExactTimeSynchronizer(("a", "b"))
    sync.add("a", 1, "A")
    sync.clear()
    assert sync.add("b", 1, "B") is None
    assert sync.dropped == 0


@given(st.permutations([(source, stamp) for stamp in range(3) for source in SOURCES]))
def test_every_set_is_given_once_in_whatever_order_messages_arrive(arrivals):
    sync = ExactTimeSynchronizer(SOURCES)
    complete = [done for source, stamp in arrivals if (done := sync.add(source, stamp, stamp))]
    assert sorted(done["a"] for done in complete) == [0, 1, 2]
    assert all(len(set(done.values())) == 1 and set(done) == set(SOURCES) for done in complete)
