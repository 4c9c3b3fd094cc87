"""A bridge that is started again goes on with the run, or knows that it has ended."""

from __future__ import annotations

import pytest
from tracked_runs import number, telemetry, track, tracker_at_ten

from rover_bridge.run_tracker import MOST_ABSENCE, RunTracker
from rover_common.types import Run


@pytest.fixture
def tracker() -> RunTracker:
    return tracker_at_ten()


def again(tracker: RunTracker) -> RunTracker:
    memory = tracker.memory()
    assert memory is not None
    resumed = RunTracker()
    resumed.resume(*memory)
    return resumed


def test_it_goes_on_with_the_run_of_a_simulator_that_goes_on(tracker):
    run, stamp = track(tracker, 20.0, x=130.0, samples=5)
    resumed = again(tracker)
    same, later = resumed.track(telemetry(x=131.0, samples=5), 20.0)
    assert same == run
    assert later > stamp + 10  # of those that were stamped after the state was saved
    assert resumed.track(telemetry(x=131.0, samples=5), 20.04)[1] > later


def test_a_simulator_that_is_started_again_begins_the_next_run(tracker):
    stamp = track(tracker, 20.0, x=130.0, samples=5)[1]
    run, later = track(again(tracker), 1.0)
    assert run.number == 2
    assert run.start == later > stamp


def test_one_without_a_clock_that_stands_at_the_start_begins_the_next_run(tracker):
    track(tracker, 1.7e9, sim_time=None)
    track(tracker, 1.7e9 + 10.0, sim_time=None, x=130.0)
    assert number(again(tracker), 1.7e9 + 20.0, sim_time=None, x=129.0) == 2
    assert number(again(tracker), 1.7e9 + 20.0, sim_time=None) == 3


def test_a_rover_that_has_not_left_its_start_goes_on(tracker):
    assert number(again(tracker), 10.1) == 1


def test_one_without_a_clock_begins_the_next_run_after_a_long_absence(tracker):
    track(tracker, 1.7e9, sim_time=None)
    track(tracker, 1.7e9 + 10.0, sim_time=None, x=130.0)
    later = 1.7e9 + 10.0 + MOST_ABSENCE
    assert number(again(tracker), later - 1.0, sim_time=None, x=131.0) == 2
    assert number(again(tracker), later + 1.0, sim_time=None, x=131.0) == 3


def test_a_memory_that_is_none_changes_nothing():
    tracker = RunTracker()
    for values in ({}, {"offset": 0, "last": {}, "first": {}}, {"offset": None}):
        with pytest.raises((KeyError, TypeError, ValueError)):
            tracker.resume(Run(7, 0), 0, values)
    assert number(tracker, 1.0) == 1


def test_there_is_no_memory_before_the_first_telemetry():
    assert RunTracker().memory() is None
