"""The order in which the node handles what clients sent."""

from hypothesis import given
from hypothesis import strategies as st

from rover_bridge.inbox import MAX_REPORTS, Inbox
from rover_bridge.rate_limit import TokenBucket
from rover_bridge.transport import ProtocolErrorReported, TelemetryReceived

CLIENTS = st.lists(st.sampled_from("abcd"), max_size=60)


def taken(inbox: Inbox) -> list[TelemetryReceived]:
    events = []
    while (event := inbox.take()) is not None:
        events.append(event)
    return events


@given(CLIENTS)
def test_nothing_is_lost_and_each_clients_order_is_kept(clients):
    inbox = Inbox()
    for number, client in enumerate(clients):
        inbox.put(TelemetryReceived(client, number))
    events = taken(inbox)
    assert len(events) == len(clients)
    for client in "abcd":
        numbers = [event.wire for event in events if event.client == client]
        assert numbers == [n for n, sender in enumerate(clients) if sender == client]


@given(CLIENTS)
def test_a_clients_next_event_waits_for_one_of_each_other_client_at_most(clients):
    inbox = Inbox()
    for client in clients:
        inbox.put(TelemetryReceived(client, None))
    inbox.put(TelemetryReceived("good", None))
    order = [event.client for event in taken(inbox)]
    assert order.index("good") <= len(set(clients))


def test_reports_of_no_client_are_bounded():
    inbox = Inbox()
    for _ in range(10 * MAX_REPORTS):
        inbox.put(ProtocolErrorReported("x"))
    assert len(taken(inbox)) == MAX_REPORTS


@given(
    rate=st.floats(0.5, 1000.0),
    burst=st.floats(1.0, 50.0),
    pauses=st.lists(st.floats(0.0, 2.0), min_size=1, max_size=50),
)
def test_a_bucket_lets_no_more_pass_than_its_burst_and_its_rate(rate, burst, pauses):
    bucket = TokenBucket(rate, burst)
    now = start = 100.0
    for count, pause in enumerate(pauses, 1):
        now += pause
        now += bucket.take(now)  # who takes waits before it goes on
        assert count <= burst + rate * (now - start) + 1e-6 * count * rate


def test_who_keeps_to_the_rate_never_waits():
    bucket = TokenBucket(10.0, 1.0)
    assert all(bucket.take(100.0 + 0.11 * n) == 0.0 for n in range(50))
