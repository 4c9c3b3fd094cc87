"""Looks at the running graph: `python -m rover_tools.doctor.node_look`, by ./rover doctor."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterable

from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rosgraph_msgs.msg import Clock

from rover_common.ros import qos
from rover_tools.doctor.__main__ import report
from rover_tools.doctor.finding import Finding
from rover_tools.doctor.graph import CLOCK, Endpoint, check_clock, check_qos
from rover_tools.runner.domain import DomainError, chosen_domain
from rover_tools.runner.node_in_domain import NodeInDomain

NAME = "doctor"
SECONDS = 3.0  # [s] for the nodes to be found, and for a time to come


def look(domain_id: int, seconds: float = SECONDS) -> list[Finding]:
    """The findings about the graph of a domain; in order where no node runs."""
    times: list[Clock] = []
    publishers: list[Endpoint] = []
    subscriptions: list[Endpoint] = []
    with NodeInDomain(NAME, domain_id) as own:
        own.node.create_subscription(Clock, CLOCK, times.append, qos.CLOCK)
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            own.executor.spin_once(timeout_sec=0.1)
        for topic, _ in own.node.get_topic_names_and_types():
            publishers += _endpoints(topic, own.node.get_publishers_info_by_topic(topic))
            subscriptions += _endpoints(topic, own.node.get_subscriptions_info_by_topic(topic))
    return [
        check_clock(publishers, subscriptions, bool(times)),
        check_qos(publishers, subscriptions),
    ]


def _endpoints(topic: str, infos: Iterable[TopicEndpointInfo]) -> list[Endpoint]:
    return [
        Endpoint(
            topic,
            info.node_name,
            info.qos_profile.reliability == ReliabilityPolicy.RELIABLE,
            info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL,
        )
        for info in infos
        if info.node_name != NAME
    ]


def main() -> int:
    """Returns the exit code."""
    try:
        domain = chosen_domain() or 0
    except DomainError:
        return 1  # another check has told
    return report(look(domain))


if __name__ == "__main__":
    sys.exit(main())
