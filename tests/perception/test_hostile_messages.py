"""No message ends the perception node: what cannot be used is dropped and counted."""

from __future__ import annotations

from array import array

import numpy as np
import pytest
from geometry_msgs.msg import Quaternion
from node_peer import IMAGE, POSE, Peer

from rover_common import frames, topics
from rover_common.ros import conversions
from rover_common.ros.message_checks import INVALID, ImageMessageError


@pytest.fixture
def peer(ros) -> Peer:
    return Peer(ros)


def send(peer: Peer, stamp: int, rotation: Quaternion, frame: str = frames.ODOM) -> None:
    """A telemetry whose odometry has this rotation and this frame of reference."""
    publish = peer._odometry.publish

    def changed(message) -> None:
        message.pose.pose.orientation = rotation
        message.header.frame_id = frame
        publish(message)

    peer._odometry.publish = changed
    try:
        peer.send(stamp)
    finally:
        peer._odometry.publish = publish


def test_what_is_no_rotation_or_in_another_frame_is_not_mapped(ros, peer):
    counts, scans = peer.node._diagnostics.counts, peer.got[topics.FREE_SCAN]
    lengths = [0.0, 0.5, 2.0, float("inf")]
    for number, length in enumerate(lengths, start=1):
        send(peer, 1_000_000_000 + number, Quaternion(x=0.0, y=0.0, z=0.0, w=length))
        assert ros.spin_until(lambda number=number: counts[INVALID] == number)
    send(peer, 2_000_000_000, Quaternion(), "moon")
    assert ros.spin_until(lambda: counts[INVALID] == len(lengths) + 1)
    assert (peer.node._core.world_map().cells < 0).all()
    peer.send(3_000_000_000)
    assert ros.spin_until(lambda: scans)


def test_an_image_with_longer_rows_is_the_same_image(ros, peer):
    scans = peer.got[topics.FREE_SCAN]
    peer.send(1_000_000_000)
    assert ros.spin_until(lambda: len(scans) == 1)
    height, width, _ = IMAGE.shape
    rows = np.zeros((height, 3 * width + 64), np.uint8)
    rows[:, : 3 * width] = IMAGE.reshape(height, -1)
    peer.send(1_040_000_000, POSE, step=rows.shape[1], data=array("B", rows.tobytes()))
    assert ros.spin_until(lambda: len(scans) == 2)
    assert scans[0].ranges == scans[1].ranges
    assert conversions.stamp_of(scans[1].header.stamp) == 1_040_000_000


@pytest.mark.parametrize("size", [0, 1, 160 * 960 - 1])
def test_an_image_shorter_than_it_says_is_dropped(ros, peer, size):
    counts = peer.node._diagnostics.counts
    peer.send(1_000_000_000, data=array("B", bytes(size)))
    assert ros.spin_until(lambda: counts[ImageMessageError.counter] == 1)
