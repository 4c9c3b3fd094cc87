"""A bridge with a node that answers its frames."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import pytest
from answering_server import Answering
from wire_clients import Decider

from rover_bridge.node import BridgeNode
from rover_bridge.transport import WireLimits
from rover_common import topics


class Pair(NamedTuple):
    node: BridgeNode
    decider: Decider

    @property
    def port(self) -> int:
        return self.node.port


@pytest.fixture
def bridge(ros) -> Pair:
    node = ros.add(BridgeNode, port=0, answer_deadline=5.0)
    decider = ros.add(Decider)
    assert ros.spin_until(lambda: node.count_subscribers(topics.COMMAND) > 0)
    assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)
    return Pair(node, decider)


@pytest.fixture
def serve() -> Iterator[Callable[..., Answering]]:
    started: list[Answering] = []

    def start(**limits: float) -> Answering:
        started.append(Answering(WireLimits(**limits)))
        return started[-1]

    yield start
    for answering in started:
        answering.server.close()
