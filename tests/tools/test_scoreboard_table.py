"""The scoreboard's table and its report."""

from __future__ import annotations

import pytest
from scoreboard_rows import entry_of, failed_entry, job_of, row_of

from rover_tools.scoreboard import board
from rover_tools.scoreboard.board import as_text
from rover_tools.scoreboard.figures import Share, Spread
from rover_tools.scoreboard.job import Ground
from rover_tools.scoreboard.rover_board import BOARD
from rover_tools.scoreboard.rover_table import LEGEND, is_home


def summaries(entries):
    return board.summaries(BOARD, entries)


# The table


def test_wilson_interval_by_hand():
    # p = 1/2, n = 4, z = 1.96: half width z sqrt(p (1 - p) / n + z^2 / 4 n^2) / (1 + z^2 / n)
    share = Share.of([True, False, True, False])
    assert (share.count, share.total) == (2, 4)
    assert (share.low, share.high) == (
        pytest.approx(0.150, abs=1e-3),
        pytest.approx(0.850, abs=1e-3),
    )
    # p = 1: from n / (n + z^2) to 1
    assert Share.of([True] * 40).low == pytest.approx(40 / (40 + 1.96**2), abs=1e-3)
    assert str(Share.of([True] * 40)) == "40 of 40 (91-100 %)"
    assert str(Share.of([])) == "0 of 0 (0-100 %)"


def test_spread_leaves_out_what_is_not_known():
    assert Spread.of([4.0, None, 1.0, 1.0], max) == Spread(2.0, 1.0, 4.0)
    assert Spread.of([4.0, 1.0, 1.0], min).worst == 1.0


def test_summary_by_hand():
    rows = [
        entry_of(job_of(seed=1)),
        entry_of(job_of(seed=2), time=300.0, percent_mapped=90.0, samples_collected=5),
        entry_of(job_of(seed=3), done=False, reason="the time is up", time=900.0),
        failed_entry(job_of(seed=4)),
        entry_of(job_of("frontier", seed=1), time=250.0),
    ]
    frontier, tour = summaries(rows)
    assert (frontier.strategy, tour.strategy) == ("frontier", "tour")
    assert (tour.missions, tour.failed) == (4, 1)
    assert (tour.home.count, tour.home.total) == (2, 4)
    assert (tour.all_samples.count, tour.all_samples.total) == (2, 4)
    assert (tour.time.median, tour.time.worst) == (300.0, 900.0)
    assert tour.time.mean == pytest.approx(1400 / 3)
    assert (tour.mapped.median, tour.mapped.worst) == (98.0, 90.0)
    assert (tour.oracle_ratio.mean, tour.oracle_ratio.worst) == (2.5, 3.0)  # of those at home
    assert (tour.contacts.mean, tour.recoveries.mean) == (1.0, 2.0)
    text = as_text([frontier, tour], LEGEND)
    assert "2 of 4 (15-85 %)" in text
    assert "4, 1 failed" in text
    assert "467 / 300 / 900" in text


def test_home_is_near_the_start_whatever_the_rover_reports():
    assert is_home(row_of(job_of()))
    assert not is_home(row_of(job_of(), home_distance=2.1))
    assert not is_home(row_of(job_of(), done=False))
    assert not is_home(failed_entry(job_of()).result)


def test_groups_are_apart():
    ground = Ground("drawn", (200, 200), b"\xff" * 5000)
    rows = [entry_of(job_of()), entry_of(job_of(ground=ground))]
    assert [(row.group, row.missions) for row in summaries(rows)] == [
        ("drawn", 1),
        ("generated", 1),
    ]
