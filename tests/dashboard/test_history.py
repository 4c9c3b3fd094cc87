"""What a late viewer gets: logs with cursors, and the history of a run."""

from __future__ import annotations

from itertools import pairwise

import pytest

from rover_common.geometry import Pose
from rover_common.types import Run, VehicleState
from rover_dashboard.history import PERIOD, SAMPLES, History, StateReport
from rover_dashboard.log import Cursor, Log, every_second, newer_half

SECOND = 1_000_000_000
SPACING = 0.25  # [m]  # [ns]


class Clock:
    """Wall time that a test sets."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def frame(stamp: int, x: float, run: Run, speed: float = 1.0) -> VehicleState:
    return VehicleState(stamp, Pose(x, 50.0, 0.0), speed, False, False, 6, run)


def rows(history: History, name: str) -> list:
    news = history.since(name, Cursor())
    assert news is not None
    return news.rows


def test_a_reader_gets_each_row_once():
    log = Log(10, every_second)
    log.append((1,))
    first = log.since(Cursor())
    assert (first.restart, first.rows) == (True, [(1,)])
    assert log.since(first.cursor) is None
    log.append((2,))
    second = log.since(first.cursor)
    assert (second.restart, second.rows) == (False, [(2,)])


def test_a_log_that_was_cleared_starts_anew_at_every_reader():
    log = Log(10, every_second)
    log.append((1,))
    cursor = log.since(Cursor()).cursor
    log.clear()
    news = log.since(cursor)
    assert (news.restart, news.rows) == (True, [])
    assert log.since(news.cursor) is None


@pytest.mark.parametrize(("thin", "kept"), [(every_second, [0, 2, 4]), (newer_half, [2, 3, 4])])
def test_a_full_log_is_thinned_and_sent_again(thin, kept):
    log = Log(4, thin)
    for number in range(4):
        assert not log.append((number,))
    cursor = log.since(Cursor()).cursor
    assert log.append((4,))
    news = log.since(cursor)
    assert news.restart
    assert [row[0] for row in news.rows] == kept


def test_the_track_has_a_point_whenever_the_rover_has_moved_on():
    history, run = History(), Run(1, 0)
    for index in range(100):
        history.add_frame(frame(index * SECOND // 25, 10.0 + 0.1 * index, run), (0.0,), SPACING)
    xs = [x for x, _ in rows(history, "track")]
    assert xs[0] == 10.0
    assert all(b - a >= SPACING for a, b in pairwise(xs))
    assert xs[-1] > 19.5


def test_a_sample_has_the_frame_rate_the_latency_and_the_age_of_the_map():
    clock = Clock()
    history, run = History(clock), Run(1, 20 * SECOND)
    for index in range(11):
        stamp = run.start + index * SECOND // 20
        history.add_map(stamp - SECOND // 4)
        history.add_frame(frame(stamp, 10.0, run, speed=1.5), (5.7, None), SPACING)
        clock.now += 0.01
        history.add_command(stamp)
    first, second = rows(history, "plots")
    assert (first[0], first[4]) == (0.0, None)  # no rate of a single frame
    assert second == pytest.approx((PERIOD, 1.5, 5.7, None, 100.0, 10.0, 0.25))


def test_samples_grow_sparser_instead_of_more():
    history, run = History(), Run(1, 0)
    seconds = 3 * SAMPLES * PERIOD
    for index in range(round(seconds / PERIOD) + 1):
        history.add_frame(frame(round(index * PERIOD * SECOND), 10.0, run), (0.0,), SPACING)
    times = [row[0] for row in rows(history, "plots")]
    assert SAMPLES / 2 <= len(times) <= SAMPLES
    assert times[0] <= 4 * PERIOD
    assert times[-1] > 0.99 * seconds


def test_the_timeline_has_each_change_of_state_once():
    history, run = History(), Run(1, 0)
    history.add_frame(frame(0, 10.0, run), (0.0,), SPACING)
    for stamp, name in ((0, "IDLE"), (1, "FORWARD"), (2, "FORWARD"), (3, "STOP")):
        history.add_state(StateReport(stamp * SECOND, 1, name, "why"))
    assert rows(history, "timeline") == [
        (0.0, "IDLE", "why"), (1.0, "FORWARD", "why"), (3.0, "STOP", "why")
    ]  # fmt: skip


def test_another_run_clears_everything():
    history = History()
    assert history.add_frame(frame(0, 10.0, Run(1, 0)), (0.0,), SPACING)
    history.add_state(StateReport(0, 1, "FORWARD", ""))
    assert not history.add_frame(frame(1, 11.0, Run(1, 0)), (0.0,), SPACING)
    assert history.add_frame(frame(5 * SECOND, 99.0, Run(2, 5 * SECOND)), (0.0,), SPACING)
    assert rows(history, "track") == [(99.0, 50.0)]
    assert [row[0] for row in rows(history, "plots")] == [0.0]
    assert rows(history, "timeline") == []


def test_a_state_that_comes_before_its_runs_first_frame_is_kept():
    history = History()
    history.add_frame(frame(0, 10.0, Run(1, 0)), (0.0,), SPACING)
    history.add_state(StateReport(5 * SECOND, 2, "FORWARD", "early"))
    assert rows(history, "timeline") == []
    history.add_frame(frame(5 * SECOND, 10.0, Run(2, 5 * SECOND)), (0.0,), SPACING)
    assert rows(history, "timeline") == [(0.0, "FORWARD", "early")]


def test_a_state_of_a_run_that_has_ended_is_not_shown():
    history = History()
    history.add_frame(frame(5 * SECOND, 10.0, Run(2, 5 * SECOND)), (0.0,), SPACING)
    history.add_state(StateReport(4 * SECOND, 1, "STOP", ""))
    assert rows(history, "timeline") == []
