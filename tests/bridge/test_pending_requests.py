"""Every telemetry gets exactly one answer, and never one that harms."""

import pytest

from rover_bridge.counters import Counter
from rover_bridge.pending_requests import (
    MAX_PENDING,
    PICKUP_TELEMETRIES,
    PendingRequest,
    PendingRequests,
)
from rover_common.types import SAFE_COMMAND, Command

DRIVE = Command(throttle=0.5)
PICKUP = Command(brake=1.0, pickup=True)


def request(stamp: int, **changes) -> PendingRequest:
    values = {
        "client": "a",
        "stamp": stamp,
        "arrived": 0.0,
        "speed": 0.0,
        "near_sample": False,
        "picking_up": False,
    }
    return PendingRequest(**(values | changes))


@pytest.fixture
def requests() -> PendingRequests:
    return PendingRequests(deadline=0.5)


def test_a_decision_answers_its_own_frame_once(requests):
    requests.add(request(1))
    requests.add(request(2))
    assert requests.answer(2, DRIVE).command == DRIVE
    assert requests.answer(2, DRIVE) is None
    assert requests.answer(1, DRIVE).client == "a"
    assert requests.answer(3, DRIVE) is None


def test_a_late_frame_is_answered_with_the_brake_and_never_again(requests):
    requests.add(request(1, arrived=10.0))
    assert requests.expire(10.4) == []
    (answer,) = requests.expire(10.5)
    assert answer.command == SAFE_COMMAND
    assert answer.counter == Counter.DEADLINE_MISSED
    assert requests.expire(11.0) == []
    assert requests.answer(1, DRIVE) is None


def test_nothing_is_owed_to_a_client_that_has_left(requests):
    requests.add(request(1))
    assert not requests.empty
    requests.clear()
    assert requests.empty
    assert requests.answer(1, DRIVE) is None


def test_more_pending_requests_than_a_simulator_sends_are_noticed(requests):
    for stamp in range(MAX_PENDING):
        assert not requests.full
        requests.add(request(stamp))
    assert requests.full
    requests.answer(0, DRIVE)
    assert not requests.full


def test_a_pickup_needs_a_sample_in_reach_and_a_standing_rover(requests):
    requests.add(request(1, near_sample=True))
    assert requests.answer(1, PICKUP).command.pickup


@pytest.mark.parametrize(
    ("state", "counter"),
    [
        ({"near_sample": False}, Counter.PICKUP_REFUSED),
        ({"near_sample": True, "speed": 0.5}, Counter.PICKUP_REFUSED),
        ({"near_sample": True, "speed": -0.5}, Counter.PICKUP_REFUSED),
        ({"near_sample": True, "picking_up": True}, Counter.PICKUP_ALREADY_RUNNING),
    ],
)
def test_a_pickup_that_would_harm_becomes_the_brake(requests, state, counter):
    requests.add(request(1, **state))
    answer = requests.answer(1, PICKUP)
    assert answer.command == SAFE_COMMAND
    assert answer.counter == counter


def test_one_pickup_per_sequence_with_several_pending_requests(requests):
    for stamp in (1, 2, 3):
        requests.add(request(stamp, near_sample=True))
    assert requests.answer(1, PICKUP).command.pickup
    assert not requests.answer(2, PICKUP).command.pickup
    assert not requests.answer(3, PICKUP).command.pickup
    requests.add(request(4, near_sample=True, picking_up=True))
    assert not requests.answer(4, PICKUP).command.pickup
    requests.add(request(5, near_sample=True))  # the sequence is over, another sample is near
    assert requests.answer(5, PICKUP).command.pickup


def test_a_pickup_that_never_showed_may_be_sent_again(requests):
    requests.add(request(0, near_sample=True))
    assert requests.answer(0, PICKUP).command.pickup
    for stamp in range(1, PICKUP_TELEMETRIES + 1):
        requests.add(request(stamp, near_sample=True))
    assert requests.answer(PICKUP_TELEMETRIES, PICKUP).command.pickup


def test_an_older_frame_cannot_start_a_second_pickup(requests):
    for stamp in (1, 2):
        requests.add(request(stamp, near_sample=True))
    assert requests.answer(1, PICKUP).command.pickup
    requests.add(request(3, near_sample=True, picking_up=True))
    assert requests.answer(2, PICKUP).counter == Counter.PICKUP_ALREADY_RUNNING


def test_no_pickup_when_a_newer_frame_shows_the_sample_out_of_reach(requests):
    requests.add(request(1, near_sample=True))
    requests.add(request(2, near_sample=False))
    assert requests.answer(1, PICKUP).counter == Counter.PICKUP_REFUSED
