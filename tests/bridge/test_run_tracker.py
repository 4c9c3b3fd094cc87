"""When a run begins, and that stamps only ever rise."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_bridge.run_tracker import CLOCK_FELL_BACK, POSE_JUMPED, RunTracker
from rover_common.geometry import Pose
from rover_common.types import Telemetry
from rover_common.vehicle import ROVER

SECOND = 1_000_000_000  # [ns]


def telemetry(
    x: float = 100.0, y: float = 80.0, samples: int = 6, sim_time: float | None = 0.0
) -> Telemetry:
    return Telemetry(
        pose=Pose(x, y, 0.0),
        speed=0.0,
        throttle=0.0,
        brake=0.0,
        steering_angle=0.0,
        near_sample=False,
        picking_up=False,
        sample_count=samples,
        samples=np.zeros((samples, 2)),
        jpeg=b"",
        image=np.zeros((1, 1, 3), np.uint8),
        sim_time=sim_time,
    )


@pytest.fixture
def tracker() -> RunTracker:
    """In its first run, at 10 s."""
    tracker = RunTracker()
    run, stamp = tracker.track(telemetry(), 10.0)
    assert (run.number, run.start, stamp) == (1, 10 * SECOND, 10 * SECOND)
    return tracker


def number(tracker: RunTracker, time: float, **changes: float | None) -> int:
    """The run that a telemetry at this time [s] belongs to."""
    return tracker.track(telemetry(**changes), time)[0].number


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
    assert number(tracker, 12.0, samples=5) == 1
    assert number(tracker, 13.0, samples=6) == 2


def test_a_clock_of_another_source_begins_a_run(tracker):
    assert number(tracker, 1.7e9, sim_time=None) == 2
    assert number(tracker, 1.7e9 + 1, sim_time=None) == 2
    assert number(tracker, 1.7e9 + 2) == 3


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
    stamps = [tracker.track(telemetry(), time)[1] for time in (10.0, 10.0, 10.5)]
    assert stamps == [10 * SECOND + 1, 10 * SECOND + 2, 10 * SECOND + SECOND // 2]


def test_a_run_whose_clock_falls_back_continues_after_the_stamps_before(tracker):
    run, stamp = tracker.track(telemetry(), 1.0)
    assert run.number == 2
    assert run.start == stamp == 10 * SECOND + 1
    assert tracker.track(telemetry(), 1.5)[1] == stamp + SECOND // 2  # time passes as it did


def test_a_run_whose_clock_is_ahead_has_the_clock_as_its_stamp(tracker):
    tracker.track(telemetry(), 1.0)
    run, stamp = tracker.track(telemetry(x=0.0, y=0.0), 20.0)
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
        run, stamp = tracker.track(wire, time)
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
