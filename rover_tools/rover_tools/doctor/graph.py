"""What is wrong with a running graph: a clock that nobody runs, and QoS that cannot match."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rover_tools.doctor.finding import Finding, wrong

CLOCK = "/clock"


@dataclass(frozen=True)
class Endpoint:
    """A publisher or a subscription of the running graph."""

    topic: str
    node: str
    reliable: bool
    latched: bool  # transient local


def check_clock(
    publishers: Sequence[Endpoint], subscriptions: Sequence[Endpoint], is_running: bool
) -> Finding:
    """is_running: whether a time has come."""
    name = "clock"
    waiting = sorted(each.node for each in subscriptions if each.topic == CLOCK)
    if not waiting or is_running:
        return Finding(name)
    who = f"{', '.join(waiting[:3])} {'waits' if len(waiting) == 1 else 'wait'} for {CLOCK}"
    if not any(each.topic == CLOCK for each in publishers):
        return wrong(
            name,
            f"{who}, which nobody publishes: start a simulator, or set use_sim_time to false",
        )
    return wrong(name, f"{who}, which stands still: connect or resume the simulator")


def check_qos(publishers: Sequence[Endpoint], subscriptions: Sequence[Endpoint]) -> Finding:
    name = "QoS"
    for publisher, subscription in _pairs(publishers, subscriptions):
        for offered, asked, what in (
            (publisher.reliable, subscription.reliable, "reliable delivery"),
            (publisher.latched, subscription.latched, "transient local durability"),
        ):
            if asked and not offered:
                return wrong(
                    name,
                    f"{subscription.node} hears nothing of {publisher.node} on {publisher.topic}: "
                    f"it asks for {what}, which is not offered; publish with it, or "
                    "subscribe with less (rover_common/README.md lists the profiles)",
                )
    return Finding(name)


def _pairs(
    publishers: Sequence[Endpoint], subscriptions: Sequence[Endpoint]
) -> Iterable[tuple[Endpoint, Endpoint]]:
    for publisher in publishers:
        for subscription in subscriptions:
            if subscription.topic == publisher.topic:
                yield publisher, subscription
