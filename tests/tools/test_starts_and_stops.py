"""A run that is ended by a signal leaves no process and no shared memory."""

from __future__ import annotations

import signal

import pytest
from starts_and_stops import SIGNALS, Started
from waiting import holds

from rover_tools.runner.graph import NODES

WAIT = 60.0  # [s]


@pytest.mark.parametrize("number", SIGNALS, ids=lambda number: signal.Signals(number).name)
def test_a_demo_that_is_ended_leaves_nothing(tmp_path, number):
    started = Started("demo", tmp_path)
    try:
        assert holds(lambda: len(started.pids()) > len(NODES) and started.memory(), WAIT)
        assert started.end(number) == []
    finally:
        started.kill()
