"""A clock that jumps, stands or is gone is refused until it goes on."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_bridge.errors import (
    ClockAbsentError,
    ClockJumpedError,
    ClockStandsError,
    TelemetryError,
)
from rover_bridge.telemetry_clock import (
    CONFIRMATIONS,
    JUMPED_AHEAD,
    STANDING_TELEMETRIES,
    STANDS,
    TelemetryClock,
)

WALL = 1.7e9  # [s]
PERIOD = 0.04  # [s]
HOUR = 3600.0


class Client:
    """Sends telemetries at a rate."""

    def __init__(self, required: bool = False) -> None:
        self.clock = TelemetryClock(WALL, 50.0, required)
        self.now = 50.0

    def send(self, sim_time: float | None, anew: bool = False) -> float:
        self.now += PERIOD
        return self.clock.read(sim_time, self.now, anew)

    def refused(self, sim_time: float | None) -> TelemetryError | None:
        try:
            self.send(sim_time)
        except TelemetryError as error:
            return error
        return None


@pytest.fixture
def client() -> Client:
    """Its clock reads 10 s."""
    made = Client()
    for step in range(1, 251):
        assert made.send(step * PERIOD) == pytest.approx(step * PERIOD)
    return made


@pytest.mark.parametrize("jump", [HOUR, 1e9 - 10.0, JUMPED_AHEAD + 2.0, -HOUR / 1000.0, -1.0])
def test_one_telemetry_of_another_time_is_refused_and_nothing_else_changes(client, jump):
    error = client.refused(10.0 + jump)
    assert isinstance(error, ClockJumpedError)
    assert ("ahead" in str(error)) == (jump > 0)
    assert client.send(10.08) == pytest.approx(10.08)


def test_one_rendered_frame_of_another_time_is_refused_however_often_it_comes(client):
    for _ in range(2 * CONFIRMATIONS):
        assert client.refused(10.0 + HOUR)
    assert client.send(10.5) == pytest.approx(10.5)


def test_a_clock_that_stays_ahead_goes_on_where_the_time_was(client):
    refused = [client.refused(10.0 + HOUR + step * PERIOD) for step in range(CONFIRMATIONS)]
    assert all(isinstance(error, ClockJumpedError) for error in refused)
    time = client.send(10.0 + HOUR + CONFIRMATIONS * PERIOD)
    assert time == pytest.approx(10.0 + CONFIRMATIONS * PERIOD)
    assert client.send(10.0 + HOUR + 1.0) == pytest.approx(11.0)


def test_a_clock_that_returns_from_ahead_goes_on_as_well(client):
    for step in range(20):
        client.refused(10.0 + HOUR + step * PERIOD)
    for step in range(CONFIRMATIONS):
        assert client.refused(11.0 + step * PERIOD)
    assert client.send(11.0 + CONFIRMATIONS * PERIOD) == pytest.approx(
        11.0 + CONFIRMATIONS * PERIOD
    )


def test_a_clock_that_stays_behind_is_taken_as_it_is(client):
    for step in range(CONFIRMATIONS):
        assert isinstance(client.refused(1.0 + step * PERIOD), ClockJumpedError)
    assert client.send(1.0 + CONFIRMATIONS * PERIOD) == pytest.approx(1.0 + CONFIRMATIONS * PERIOD)


def test_a_reloaded_simulator_begins_at_once_on_another_connection(client):
    assert client.send(1.0, anew=True) == 1.0
    assert client.send(1.04) == pytest.approx(1.04)


def test_another_connection_does_not_bring_the_time_forward(client):
    assert client.send(10.0 + HOUR, anew=True) == pytest.approx(10.0)


def test_time_that_passed_without_a_connection_is_no_jump(client):
    client.now += 60.0
    assert client.send(10.0 + 10 * 60.0) == pytest.approx(610.0)  # ten times real time


def test_pending_requests_of_one_instant_are_no_clock_that_stands(client):
    for _ in range(3):
        assert client.send(10.0) == pytest.approx(10.0)


def test_a_clock_that_stands_is_refused_until_it_goes_on(client):
    errors = [client.refused(10.0) for _ in range(100)]
    assert errors[:STANDING_TELEMETRIES] == [None] * STANDING_TELEMETRIES
    first = next(index for index, error in enumerate(errors) if error)
    assert first * PERIOD == pytest.approx(STANDS, abs=2 * PERIOD)
    assert all(isinstance(error, ClockStandsError) for error in errors[first:])
    assert client.send(10.04) == pytest.approx(10.04)


def test_a_clock_that_is_gone_or_comes_has_to_be_confirmed(client):
    for _ in range(CONFIRMATIONS):
        assert isinstance(client.refused(None), ClockAbsentError)
    assert client.send(None) == pytest.approx(WALL + client.now - 50.0)
    for step in range(CONFIRMATIONS):
        assert isinstance(client.refused(20.0 + step), ClockJumpedError)
    assert client.send(25.0) == 25.0


def test_without_a_clock_the_machines_time_is_steady():
    client = Client()
    times = [client.send(None) for _ in range(100)]
    assert times[0] == pytest.approx(WALL + PERIOD)
    assert all(b - a == pytest.approx(PERIOD, abs=1e-5) for a, b in pairwise(times))


def test_simulated_time_needs_a_clock_and_says_how_to_do_without():
    client = Client(required=True)
    for _ in range(20):
        error = client.refused(None)
        assert isinstance(error, ClockAbsentError)
        assert "use_sim_time" in str(error)
    assert client.send(7.0) == 7.0


@given(
    st.lists(
        st.tuples(st.floats(0.0, 1e9) | st.none(), st.floats(0.0, 10.0), st.booleans()),
        max_size=40,
    )
)
def test_whatever_comes_time_never_jumps_ahead_within_a_connection(steps):
    clock, now = TelemetryClock(WALL, 0.0, required=False), 0.0
    last: tuple[float, float, bool] | None = None  # time, now, simulated
    for sim_time, wait, anew in steps:
        now += wait
        try:
            time = clock.read(sim_time, now, anew)
        except TelemetryError:
            continue
        simulated = sim_time is not None
        if last is not None and last[2] == simulated and simulated:
            assert time - last[0] <= JUMPED_AHEAD * (CONFIRMATIONS + 1) + 20.0 * (now - last[1])
        last = time, now, simulated
