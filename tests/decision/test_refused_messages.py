"""Messages that cannot be used neither end the decision node nor cost it a frame."""

from __future__ import annotations

import pytest
from frames_by_hand import nanoseconds
from node_bench import PARTS, PERIOD, NodeBench

from rover_common import topics
from rover_tools.chaos.graph_shapes import GraphShape
from rover_tools.chaos.node_graph_faults import JUNK

HEARD = sorted(
    shape for shape, junk in JUNK.items() if junk.topic in {*PARTS, topics.NAVIGATION_MAP}
)


@pytest.mark.parametrize("shape", HEARD)
def test_a_frame_has_its_good_messages(ros, shape):
    bench = NodeBench(ros)
    bench.frame()
    junk = JUNK[GraphShape(shape)]
    publisher = bench.peer.create_publisher(type(junk.make(0)), junk.topic, junk.profile)
    assert ros.spin_until(lambda: publisher.get_subscription_count() > 0)
    publisher.publish(junk.make(nanoseconds(bench.time + PERIOD)))
    assert ros.spin_until(lambda: bench.reported("messages_refused") == "1")
    bench.frame()


def test_what_is_heard_is_harmed():
    assert len(HEARD) == 7
