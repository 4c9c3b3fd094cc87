"""No message ends the decision node: what cannot be used is dropped and counted."""

from __future__ import annotations

from array import array
from typing import Any

import pytest
from geometry_msgs.msg import Quaternion
from maps import MIDDLE, SCALE, UNKNOWN, request
from node_bench import NodeBench
from rover_interfaces.msg import PolarArray

from rover_common import topics
from rover_common.ros import conversions
from rover_common.ros.message_checks import INVALID
from rover_common.types import SAFE_COMMAND, GridMap
from rover_navigation.planner import Planner
from rover_navigation.selection import WholeTour


@pytest.fixture
def bench(ros) -> NodeBench:
    return NodeBench(ros)


def spoiled(bench: NodeBench, topic: str, spoil: Any) -> None:
    """A frame of which one message is changed before it is sent."""
    publisher = bench._parts[topic]
    publish = publisher.publish

    def changed(message: Any) -> None:
        spoil(message)
        publish(message)

    publisher.publish = changed
    try:
        bench.send()
    finally:
        publisher.publish = publish


def no_ranges(message: Any) -> None:
    message.ranges = array("f")


def no_rotation(message: Any) -> None:
    message.pose.pose.orientation = Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)


def not_a_number(message: Any) -> None:
    message.pose.pose.position.x = float("nan")


def one_bearing(message: PolarArray) -> None:
    message.bearings = array("f", [0.0])


def another_frame(message: Any) -> None:
    message.header.frame_id = "moon"


SPOILED = [
    (topics.FREE_SCAN, no_ranges),
    (topics.ODOMETRY, no_rotation),
    (topics.ODOMETRY, not_a_number),
    (topics.NAV_POLAR, one_bearing),
    (topics.ROCK_POLAR, one_bearing),
    (topics.ROCKS, another_frame),
]


def test_frames_that_cannot_be_used_are_dropped_and_the_next_one_is_decided_on(bench):
    bench.frame(pose=MIDDLE)
    counts = bench.node._diagnostics.counts
    for number, (topic, spoil) in enumerate(SPOILED, start=1):
        spoiled(bench, topic, spoil)
        assert bench.ros.spin_until(lambda number=number: counts[INVALID] == number), topic
        bench.frame(pose=MIDDLE)
    assert len(bench.commands) == 1 + len(SPOILED)
    assert bench.node._core.mission._parts.home == (MIDDLE.x, MIDDLE.y)


def test_a_latched_grid_that_is_none_does_not_end_the_node(bench):
    """It comes again after every restart."""
    counts = bench.node._diagnostics.counts
    grid = conversions.grid_message_of(1, UNKNOWN)
    for width, resolution in ((239, 0.25), (240, 0.0), (240, float("nan"))):
        grid.info.width, grid.info.resolution = width, resolution
        before = counts[INVALID]
        bench._maps.publish(grid)
        assert bench.ros.spin_until(lambda before=before: counts[INVALID] == before + 1)
    assert bench.frame(pose=MIDDLE) == SAFE_COMMAND  # it waits for a plan


@pytest.mark.parametrize("rows, cols", [(239, 240), (241, 237), (3, 3)])
def test_a_plan_is_made_of_a_grid_of_any_size(rows, cols):
    cells = UNKNOWN.cells[:1].repeat(rows, 0).repeat(2, 1)[:, :cols].copy()
    cells[rows // 3 : 2 * rows // 3 + 1, cols // 3 : 2 * cols // 3 + 1] = 0
    grid = GridMap(0.25, 0.0, 0.0, cells)
    plan = Planner(SCALE, WholeTour(SCALE)).plan(request(grid))
    assert plan.stamp == request(grid).stamp
