"""Which client is active, and that no other one becomes it because the simulator pauses."""

import pytest

from rover_bridge.active_client import SILENCE, ActiveClient

HERE, ELSEWHERE = "127.0.0.1", "192.0.2.7"


@pytest.fixture
def active() -> ActiveClient:
    """`a` is active, and was last heard at 10 s."""
    active = ActiveClient()
    active.connect("a", HERE, now=9.0)
    assert active.accepts("a", 10.0, owes=True)
    active.activate("a", 10.0)
    return active


def test_the_first_client_is_active_until_it_disconnects(active):
    active.connect("b", HERE, now=9.5)
    assert not active.accepts("b", 10.1, owes=True)
    assert not active.disconnect("b")
    assert active.name == "a"
    assert active.disconnect("a")
    active.connect("b", HERE, now=11.0)
    assert active.accepts("b", 11.1, owes=True)


def test_a_client_that_is_accepted_is_not_active_before_its_telemetry_was_used():
    active = ActiveClient()
    active.connect("a", HERE, now=0.0)
    active.connect("b", HERE, now=0.0)
    assert active.accepts("a", 1.0, owes=True)
    assert active.name is None
    assert active.accepts("b", 1.0, owes=True)


def test_a_simulator_that_was_reloaded_takes_over(active):
    active.connect("b", HERE, now=10.5)
    assert not active.accepts("b", 10.0 + SILENCE - 0.1, owes=True)
    assert not active.accepts("b", 10.0 + SILENCE, owes=False)  # it waits for an answer itself
    assert active.accepts("b", 10.0 + SILENCE, owes=True)
    assert active.silence(10.0 + SILENCE) == SILENCE
    active.activate("b", 10.0 + SILENCE)
    assert active.name == "b"
    assert not active.accepts("a", 11.0 + SILENCE, owes=True)


@pytest.mark.parametrize(
    ("address", "connected"), [(HERE, 9.5), (ELSEWHERE, 10.5), (ELSEWHERE, 9.5)]
)
def test_no_other_client_takes_over_however_long_the_simulator_pauses(active, address, connected):
    active.connect("b", address, now=connected)
    assert not active.accepts("b", 1000.0, owes=True)
    assert active.accepts("a", 1001.0, owes=True)
