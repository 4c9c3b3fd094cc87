"""When a run begins, and that stamps only ever rise."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tracked_runs import SECOND, number, telemetry, track, tracker_at_ten

from rover_bridge.run_tracker import (
    AGREEING,
    CLOCK_FELL_BACK,
    CLOCK_LEAPT,
    POSE_JUMPED,
    POSE_OUTLIER,
    RunTracker,
)
from rover_common.vehicle import ROVER


@pytest.fixture
def tracker() -> RunTracker:
    return tracker_at_ten()


STRAYS = [
    {"x": 150.0},
    {"x": 100.0 + POSE_OUTLIER + 2.0},
    {"samples": 7},
    {"samples": 0},
    {"sim_time": None},
]


def test_a_clock_that_falls_back_begins_a_run(tracker):
    assert number(tracker, 10.0 - CLOCK_FELL_BACK) == 1  # as when the network sets a wall clock
    assert number(tracker, 10.0 - 2 * CLOCK_FELL_BACK - 0.01) == 2


def test_a_pause_of_the_clock_begins_no_run(tracker):
    assert number(tracker, 10.0) == 1
    assert number(tracker, 5000.0) == 1


def test_a_pose_farther_than_can_be_driven_begins_a_run(tracker):
    driven = ROVER.max_speed * 2.0
    assert number(tracker, 12.0, x=100.0 + driven + POSE_JUMPED - 0.1) == 1
    assert number(tracker, 14.0, x=100.0 - 0.2) == 2


def test_a_rover_that_drives_at_full_speed_stays_in_its_run(tracker):
    for step in range(1, 1000):
        assert number(tracker, 10.0 + 0.1 * step, x=100.0 + ROVER.max_speed * 0.1 * step) == 1


def test_a_sample_count_that_rises_begins_a_run(tracker):
    assert number(tracker, 11.0, samples=5) == 1
    for step in range(AGREEING):
        assert number(tracker, 12.0 + step, samples=5) == 1
    assert number(tracker, 20.0, samples=6) == 2


def test_a_clock_of_another_source_begins_a_run(tracker):
    assert number(tracker, 1.7e9, sim_time=None) == 2
    assert number(tracker, 1.7e9 + 1, sim_time=None) == 2
    assert number(tracker, 1.7e9 + 2) == 3


@pytest.mark.parametrize("stray", STRAYS, ids=str)
def test_a_single_stray_telemetry_and_the_way_back_change_nothing(tracker, stray):
    before = track(tracker, 10.0)[0]
    for start in (10.1, 10.5):
        for step in range(AGREEING - 1):
            assert tracker.track(telemetry(**stray), start + 0.04 * step) is None
            assert tracker.contradiction
        assert tracker.track(telemetry(), start + 0.2)[0] == before


@pytest.mark.parametrize("stray", [9.0, 10.0 + 2 * CLOCK_LEAPT])
def test_a_single_stray_clock_and_the_way_back_change_nothing(tracker, stray):
    before = track(tracker, 10.0)[0]
    assert tracker.track(telemetry(), stray) is None
    assert tracker.track(telemetry(), 10.1)[0] == before


def test_one_telemetry_with_a_sample_too_few_makes_the_next_one_no_new_run(tracker):
    assert number(tracker, 10.1, samples=5) == 1
    assert tracker.track(telemetry(samples=6), 10.2)[0].number == 1


def test_strays_that_do_not_agree_begin_no_run(tracker):
    for step in range(3 * AGREEING):
        assert tracker.track(telemetry(x=10.0 + 80.0 * (step % 2)), 10.1) is None
    assert tracker.track(telemetry(), 10.2)[0].number == 1


def test_a_place_that_several_telemetries_agree_on_is_confirms_without_a_new_run(tracker):
    x = 100.0 + 2 * POSE_OUTLIER
    assert number(tracker, 10.0, x=x) == 1
    assert tracker.track(telemetry(x=x), 10.1)[0].number == 1


def test_a_request_begins_a_run_with_the_next_telemetry(tracker):
    tracker.request(1)
    assert number(tracker, 10.1) == 2
    assert number(tracker, 10.2) == 2


def test_requests_on_frames_of_one_run_begin_one_run(tracker):
    for _ in range(3):
        tracker.request(1)
    assert number(tracker, 10.1) == 2
    tracker.request(1)  # the answer to a frame of the run that ended
    assert number(tracker, 10.2) == 2
    tracker.request(2)
    assert number(tracker, 10.3) == 3


def test_a_request_before_a_run_that_began_by_itself_is_met_by_it(tracker):
    tracker.request(1)
    assert number(tracker, 1.0) == 2
    assert number(tracker, 1.1) == 2


def test_a_request_without_a_run_is_ignored():
    tracker = RunTracker()
    tracker.request(0)
    tracker.request(1)
    assert number(tracker, 1.0) == 1
    assert number(tracker, 1.1) == 1


def test_stamps_are_the_clock_and_differ_by_a_nanosecond_where_it_stands(tracker):
    stamps = [track(tracker, time)[1] for time in (10.0, 10.0, 10.5)]
    assert stamps == [10 * SECOND + 1, 10 * SECOND + 2, 10 * SECOND + SECOND // 2]


def test_a_run_whose_clock_falls_back_continues_after_the_stamps_before(tracker):
    run, stamp = track(tracker, 1.0)
    assert run.number == 2
    assert run.start == stamp == 10 * SECOND + 1
    assert track(tracker, 1.5)[1] == stamp + SECOND // 2  # time passes as it did


def test_a_run_whose_clock_is_ahead_has_the_clock_as_its_stamp(tracker):
    track(tracker, 1.0)
    run, stamp = track(tracker, 20.0, x=0.0, y=0.0, sim_time=None)
    assert run.number == 3
    assert run.start == stamp == 20 * SECOND


STEPS = st.lists(
    st.tuples(
        st.floats(0.0, 100.0),  # time [s]
        st.integers(0, 6),  # samples
        st.floats(0.0, 200.0),  # x [m]
        st.booleans(),  # whether the telemetry carries it as sim_time
        st.booleans(),  # whether a new run was requested before
    ),
    min_size=2,
    max_size=30,
)


@given(STEPS)
def test_stamps_rise_and_belong_to_their_run_whatever_the_simulator_sends(steps):
    tracker = RunTracker()
    runs, stamps = [], []
    for time, samples, x, simulated, requested in steps:
        if requested and runs:
            tracker.request(runs[-1].number)
        wire = replace(telemetry(x=x, samples=samples), sim_time=time if simulated else None)
        tracked = tracker.track(wire, time)
        if tracked is None:
            continue
        run, stamp = tracked
        runs.append(run)
        stamps.append(stamp)
    assert all(a < b for a, b in pairwise(stamps))
    for before, run, stamp in zip(runs, runs[1:], stamps[1:], strict=False):
        assert run.number - before.number in (0, 1)
        assert (run == before) == (run.number == before.number)
        assert (run.start == stamp) == (run.number != before.number)
        assert run.holds(stamp)
    for run, stamp in zip(runs, stamps, strict=True):
        assert all(not later.holds(stamp) for later in runs if later.number > run.number)
