"""The yaw rate is the difference of two yaws over the time between them."""

from __future__ import annotations

import math

import pytest

from rover_bridge.yaw_rate import YawRate
from rover_common.types import Run

FIRST, SECOND = Run(1, 0), Run(2, 0)
FRAME = 40_000_000  # [ns]


def test_it_is_the_difference_over_the_time_across_the_half_turn():
    rate = YawRate()
    assert rate.follow(FIRST, FRAME, math.pi - 0.01) == 0.0
    assert rate.follow(FIRST, 2 * FRAME, -math.pi + 0.01) == pytest.approx(0.5)
    assert rate.follow(FIRST, 3 * FRAME, -math.pi - 0.03) == pytest.approx(-1.0)


def test_a_telemetry_of_the_same_frame_keeps_the_rate_and_the_next_one_counts_from_the_first():
    rate = YawRate()
    rate.follow(FIRST, FRAME, 0.0)
    rate.follow(FIRST, 2 * FRAME, 0.02)
    assert rate.follow(FIRST, 2 * FRAME + 1, 0.02) == pytest.approx(0.5)
    assert rate.follow(FIRST, 3 * FRAME, 0.06) == pytest.approx(1.0)


@pytest.mark.parametrize("run, stamp", [(SECOND, 3 * FRAME), (FIRST, 60 * FRAME)])
def test_nothing_is_known_at_the_beginning_of_a_run_and_after_a_gap(run, stamp):
    rate = YawRate()
    rate.follow(FIRST, FRAME, 0.0)
    rate.follow(FIRST, 2 * FRAME, 0.1)
    assert rate.follow(run, stamp, 0.9) == 0.0
    assert rate.follow(run, stamp + FRAME, 0.94) == pytest.approx(1.0)
