"""What a mission knows by the graph's messages, and junk that is published in the graph."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rover_interfaces.msg import MissionState, RockTrackArray

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_common.types import FIRST_RUN, GridMap, RockTrack
from rover_tools.chaos import node_graph_faults
from rover_tools.chaos.graph_shapes import GRAPH_SHAPES, GraphShape
from rover_tools.chaos.node_graph_faults import JUNK, MOST, GraphFaults
from rover_tools.chaos.node_mission_watch import MissionWatch

SECOND = 1_000_000_000  # [ns]
HOME = (100.0, 80.0)  # [m]
ROCKS = tuple(RockTrack(i, 90.0 + 9 * i, 90.0, (0.1, 0.0, 0.0, 0.1), 5, 7) for i in range(3))


class Graph:
    """The nodes' messages, by hand."""

    def __init__(self, ros: Any, watch: MissionWatch) -> None:
        self.ros = ros
        self.watch = watch
        node = ros.add(lambda **kwargs: Node("graph", **kwargs))
        publish = node.create_publisher
        self._odometry = publish(Odometry, topics.ODOMETRY, qos.FRAME)
        self._mission = publish(MissionState, topics.MISSION_STATE, qos.LATCHED)
        self._grid = publish(OccupancyGrid, topics.WORLDMAP, qos.LATCHED)
        self._rocks = publish(RockTrackArray, topics.ROCKS, qos.FRAME_LATCHED)
        for publisher in (self._odometry, self._mission, self._grid, self._rocks):
            assert ros.spin_until(lambda p=publisher: p.get_subscription_count() > 0)

    def report(
        self, stamp: int, *, home: float = 5.0, cells: int = 100, rocks: int = 3, run: int = 1
    ) -> None:
        """Of a rover 5 m from home, at this stamp [ns]; `home` is what the mission says."""
        self._odometry.publish(conversions.odometry_of(stamp, Pose(103.0, 84.0, 0.5), 1.0))
        assert self.ros.spin_until(lambda: self.watch.newest() == stamp)
        known = np.full((20, 20), -1, np.int8)
        known.ravel()[:cells] = 0
        self._grid.publish(conversions.grid_message_of(stamp, GridMap(1.0, 0.0, 0.0, known)))
        self._rocks.publish(conversions.rocks_message_of(stamp, FIRST_RUN, ROCKS[:rocks], stamp))
        header = conversions.header_of(stamp, frames.MAP)
        self._mission.publish(
            MissionState(header=header, run=run, elapsed=stamp / SECOND, home_distance=home)
        )
        heard = (self.watch, "mission"), (self.watch, "grid"), (self.watch, "_rocks")
        for owner, name in heard:
            assert self.ros.spin_until(
                lambda o=owner, n=name: (
                    getattr(o, n) is not None
                    and conversions.stamp_of(getattr(o, n).header.stamp) == stamp
                )
            )


@pytest.fixture
def watch(domain_id) -> Iterator[MissionWatch]:
    with MissionWatch(domain_id, HOME) as made:
        yield made


@pytest.fixture
def graph(ros, watch) -> Graph:
    return Graph(ros, watch)


def test_a_mission_that_goes_on_has_lost_nothing(graph, watch):
    assert watch.losses() == []
    for stamp in range(SECOND, 4 * SECOND, SECOND):
        graph.report(stamp)
        assert watch.losses() == []


@pytest.mark.parametrize(
    ("change", "name"),
    [
        ({"home": 9.0}, "home"),
        ({"cells": 10}, "map"),
        ({"rocks": 1}, "rocks"),
        ({"run": 2}, "run"),
    ],
)
def test_a_message_that_has_less_is_a_loss(graph, watch, change, name):
    graph.report(SECOND)
    assert watch.losses() == []
    graph.report(2 * SECOND, **change)
    assert [loss.name for loss in watch.losses()] == [name]


def test_nodes_are_at_work_again_with_frames_after_the_mark(graph, watch):
    graph.report(3 * SECOND)
    watch.mark()
    assert not watch.recovered()
    graph.report(3 * SECOND + SECOND // 2)
    assert not watch.recovered()  # on a frame that may have been in work before
    graph.report(4 * SECOND)
    assert watch.recovered()


def test_faults_in_the_graph_are_not_what_the_mission_knows(graph, watch, domain_id):
    graph.report(SECOND)
    assert watch.losses() == []
    heard: list[Any] = []
    for shape in (GraphShape.ZERO_QUATERNION, GraphShape.ROCK_AT_NAN):
        junk = JUNK[shape]
        node = graph.ros.add(lambda **kwargs: Node("ears", **kwargs))
        node.create_subscription(type(junk.make(0)), junk.topic, heard.append, junk.profile)
        with GraphFaults(domain_id) as faults:
            stopped = iter([False, False, True])
            faults.publish(lambda: SECOND, shape, lambda s=stopped: next(s))
        assert graph.ros.spin_until(lambda: heard)
        heard.clear()
    assert watch.newest() == SECOND
    assert watch.losses() == []


def test_every_shape_is_published_and_bounded(ros, domain_id, monkeypatch):
    monkeypatch.setattr(node_graph_faults, "PERIOD", 0.002)
    heard: dict[str, list[Any]] = {shape: [] for shape in GRAPH_SHAPES}
    node = ros.add(lambda **kwargs: Node("ears", **kwargs))
    with GraphFaults(domain_id) as faults:
        for shape, messages in heard.items():
            junk = JUNK[GraphShape(shape)]
            node.create_subscription(type(junk.make(0)), junk.topic, messages.append, junk.profile)
            assert faults.publish(lambda: SECOND, shape, lambda: False) == MOST
    assert ros.spin_until(lambda: all(heard.values()))
