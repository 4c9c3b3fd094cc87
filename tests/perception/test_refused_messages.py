"""Messages that cannot be used leave their place to the good ones of their frame."""

from __future__ import annotations

import pytest
from node_peer import Peer

from rover_common import topics
from rover_tools.chaos.graph_shapes import GraphShape
from rover_tools.chaos.node_graph_faults import JUNK

STAMP = 1_000_000_000


@pytest.mark.parametrize(
    ("shape", "counter"),
    [
        (GraphShape.ZERO_QUATERNION, "frame_pose_orientation"),
        (GraphShape.NO_PIXELS, "frame_image_encoding"),
    ],
)
def test_a_frame_has_its_good_messages(ros, shape, counter):
    peer = Peer(ros)
    publisher = {topics.ODOMETRY: peer._odometry, topics.IMAGE: peer._image}[JUNK[shape].topic]
    publisher.publish(JUNK[shape].make(STAMP))
    assert ros.spin_until(lambda: peer.node._diagnostics.counts[counter] == 1)
    peer.send(STAMP)
    assert ros.spin_until(lambda: len(peer.got[topics.FREE_SCAN]) == 1)
