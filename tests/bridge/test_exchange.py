"""Every telemetry gets exactly one answer, and never one that harms."""

import pytest

from rover_bridge.pending_requests import MAX_OPEN, PICKUP_TELEMETRIES, SILENCE, Exchange, Ticket
from rover_common.types import SAFE_COMMAND, Command

DRIVE = Command(throttle=0.5)
PICKUP = Command(brake=1.0, pickup=True)


def ticket(stamp: int, **changes) -> Ticket:
    values = {
        "client": "a",
        "stamp": stamp,
        "arrived": 0.0,
        "speed": 0.0,
        "near_sample": False,
        "picking_up": False,
    }
    return Ticket(**(values | changes))


@pytest.fixture
def exchange() -> Exchange:
    exchange = Exchange(deadline=0.5)
    assert exchange.admit("a", now=0.0)
    return exchange


def test_a_decision_answers_its_own_frame_once(exchange):
    exchange.open(ticket(1))
    exchange.open(ticket(2))
    assert exchange.answer(2, DRIVE).command == DRIVE
    assert exchange.answer(2, DRIVE) is None
    assert exchange.answer(1, DRIVE).client == "a"
    assert exchange.answer(3, DRIVE) is None


def test_a_late_frame_is_answered_with_the_brake_and_never_again(exchange):
    exchange.open(ticket(1, arrived=10.0))
    assert exchange.expire(10.4) == []
    (answer,) = exchange.expire(10.5)
    assert answer.command == SAFE_COMMAND
    assert exchange.expire(11.0) == []
    assert exchange.answer(1, DRIVE) is None


def test_only_the_first_client_drives_until_it_leaves(exchange):
    assert not exchange.admit("b", now=0.1)
    exchange.open(ticket(1))
    exchange.leave("b")
    assert exchange.driver == "a"
    exchange.leave("a")
    assert exchange.answer(1, DRIVE) is None
    assert exchange.admit("b", now=0.1)


def test_stamps_of_one_time_differ(exchange):
    assert exchange.next_stamp(5_000_000) == 5_000_000
    assert exchange.next_stamp(5_000_000) == 5_000_001
    assert exchange.next_stamp(5_000_000) == 5_000_002
    assert exchange.next_stamp(9_000_000) == 9_000_000


def test_stamps_never_go_back_while_one_client_drives(exchange):
    exchange.next_stamp(100_000_000_000)
    assert exchange.next_stamp(1_000_000_000) == 100_000_000_001


def test_another_simulator_has_its_own_time(exchange):
    exchange.next_stamp(100_000_000_000)
    exchange.leave("a")
    assert exchange.admit("b", now=1.0)
    assert exchange.next_stamp(1_000_000_000) == 1_000_000_000


def test_a_silent_driver_loses_its_place(exchange):
    exchange.open(ticket(1))
    assert not exchange.admit("b", now=SILENCE)  # the driver waits for an answer itself
    exchange.answer(1, DRIVE)
    assert not exchange.admit("b", now=SILENCE - 0.1)
    assert exchange.admit("b", now=SILENCE)
    assert exchange.driver == "b"
    assert not exchange.admit("a", now=SILENCE + 0.1)


def test_a_flood_is_noticed(exchange):
    for stamp in range(MAX_OPEN):
        assert not exchange.full
        exchange.open(ticket(stamp))
    assert exchange.full
    exchange.answer(0, DRIVE)
    assert not exchange.full


def test_a_pickup_needs_a_sample_in_reach_and_a_standing_rover(exchange):
    exchange.open(ticket(1, near_sample=True))
    assert exchange.answer(1, PICKUP).command.pickup


@pytest.mark.parametrize(
    "state",
    [
        {"near_sample": False},
        {"near_sample": True, "speed": 0.5},
        {"near_sample": True, "picking_up": True},
    ],
)
def test_a_pickup_that_would_harm_becomes_the_brake(exchange, state):
    exchange.open(ticket(1, **state))
    answer = exchange.answer(1, PICKUP)
    assert answer.command == SAFE_COMMAND
    assert answer.why.startswith("pickup_")


def test_one_pickup_per_sequence_with_several_exchanges_in_flight(exchange):
    for stamp in (1, 2, 3):
        exchange.open(ticket(stamp, near_sample=True))
    assert exchange.answer(1, PICKUP).command.pickup
    assert not exchange.answer(2, PICKUP).command.pickup
    assert not exchange.answer(3, PICKUP).command.pickup
    exchange.open(ticket(4, near_sample=True, picking_up=True))
    assert not exchange.answer(4, PICKUP).command.pickup
    exchange.open(ticket(5, near_sample=True))  # the sequence is over, another sample is near
    assert exchange.answer(5, PICKUP).command.pickup


def test_a_pickup_that_never_showed_may_be_sent_again(exchange):
    exchange.open(ticket(0, near_sample=True))
    assert exchange.answer(0, PICKUP).command.pickup
    for stamp in range(1, PICKUP_TELEMETRIES + 1):
        exchange.open(ticket(stamp, near_sample=True))
    assert exchange.answer(PICKUP_TELEMETRIES, PICKUP).command.pickup


def test_an_older_frame_cannot_start_a_second_pickup(exchange):
    for stamp in (1, 2):
        exchange.open(ticket(stamp, near_sample=True))
    assert exchange.answer(1, PICKUP).command.pickup
    exchange.open(ticket(3, near_sample=True, picking_up=True))
    assert exchange.answer(2, PICKUP).why == "pickup_already_running"


def test_no_pickup_when_a_newer_frame_tells_that_the_sample_is_out_of_reach(exchange):
    exchange.open(ticket(1, near_sample=True))
    exchange.open(ticket(2, near_sample=False))
    assert exchange.answer(1, PICKUP).why == "pickup_refused"
