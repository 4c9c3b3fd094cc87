"""A trouble is told as it begins, once, however long it lasts."""

from __future__ import annotations

import pytest

from rover_common.trouble_log import PEACE, TroubleLog


def test_a_trouble_is_told_once_while_it_lasts():
    log = TroubleLog()
    told = [log.begins("deadline", 0.1 * step) for step in range(1000)]
    assert told == [True] + [False] * 999


def test_it_is_told_again_when_it_returns_after_a_while():
    log = TroubleLog()
    assert log.begins("deadline", 10.0)
    assert not log.begins("deadline", 10.0 + PEACE - 0.1)
    assert log.begins("deadline", 10.0 + 2 * PEACE)


def test_troubles_are_told_apart():
    log = TroubleLog()
    assert log.begins("deadline", 10.0)
    assert log.begins("second_client", 10.0)


def test_its_end_is_told_once_with_how_long_it_lasted():
    log = TroubleLog()
    assert log.ends("deadline", 9.0) is None
    log.begins("deadline", 10.0)
    log.begins("deadline", 13.0)
    assert log.ends("deadline", 13.0 + PEACE - 0.1) is None
    assert log.ends("deadline", 13.0 + PEACE) == pytest.approx(3.0)
    assert log.ends("deadline", 20.0) is None
