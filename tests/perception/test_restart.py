"""A perception that goes on with a run knows the map and the rocks that it had."""

from __future__ import annotations

import numpy as np
import pytest
from node_peer import IMAGE, POSE, Peer
from scene import EXACT, corridor, drive, frames
from test_runs import first_run, parts, with_rock

from rover_common import topics
from rover_common.ros import conversions
from rover_common.types import FIRST_RUN, CameraFrame, GridMap, Run
from rover_perception.config import PerceptionConfig
from rover_perception.factory import Pipeline, make_perception
from rover_perception.node import PerceptionNode

CONFIGS = {
    "exact": EXACT,
    "baseline": PerceptionConfig(recipe="baseline"),
}


@pytest.fixture(params=CONFIGS.values(), ids=CONFIGS)
def config(request) -> PerceptionConfig:
    return request.param


def after(config: PerceptionConfig, sequence: list[CameraFrame]) -> Pipeline:
    core = make_perception(config)
    for frame in sequence:
        core.process(frame)
    return core


def assert_same(one: GridMap, other: GridMap) -> None:
    assert np.array_equal(one.cells, other.cells)
    assert (one.resolution, one.origin_x, one.origin_y) == (
        other.resolution, other.origin_x, other.origin_y,
    )  # fmt: skip


def test_map_and_rocks_go_on_as_if_nothing_had_happened(config):
    before, rest = first_run()[:-3], first_run()[-3:]
    core, resumed = after(config, before), make_perception(config)
    memory = core.memory()
    core.process(rest[0])  # goes on while the copy is made into a memory
    resumed.resume(FIRST_RUN, memory())
    assert (resumed.world_map().cells >= 0).any()
    assert_same(resumed.world_map(), after(config, before).world_map())
    resumed.process(rest[0])
    for frame in rest[1:]:
        result, expected = resumed.process(frame), core.process(frame)
        assert parts(result)[:-2] == parts(expected)[:-2]  # but for when maps are due
        assert_same(resumed.world_map(), core.world_map())
        assert_same(resumed.navigation_map(), core.navigation_map())
    assert expected.rocks


def test_a_memory_of_another_grid_or_none_changes_nothing(config):
    core = after(config, first_run())
    world = core.world_map()
    values, arrays = core.memory()()
    fine = PerceptionConfig(recipe=config.recipe, evidence_resolution=0.125, map_resolution=0.5)
    for memory in (after(fine, first_run()).memory()(), (values, {}), ({}, arrays)):
        with pytest.raises((ValueError, TypeError, KeyError)):
            core.resume(FIRST_RUN, memory)
        assert_same(core.world_map(), world)


class TestNode:
    """One node after another, in the same run."""

    RUN = Run(4, 1_000_000_000)

    def drive_and_end(self, ros, peer: Peer) -> GridMap:
        scans = peer.got[topics.FREE_SCAN]
        sequence = with_rock(frames(drive(), corridor))
        for index, frame in enumerate(sequence):
            stamp = self.RUN.start + frame.stamp
            peer.send(stamp, frame.pose, frame.image, self.RUN)
            assert ros.spin_until(lambda index=index: len(scans) > index)
        self.last = stamp
        core = peer.node._core
        ros.end(peer.node)
        self.tracks = core.memory()()[0]["rocks"]["tracks"]
        return core.world_map()

    def again(self, ros, peer: Peer, run: Run, stamp: int) -> PerceptionNode:
        node = ros.add(PerceptionNode, image_lag=0)
        assert ros.spin_until(lambda: peer._status.get_subscription_count() > 0)
        assert ros.spin_until(lambda: peer._image.get_subscription_count() > 0)
        assert ros.spin_until(lambda: peer._odometry.get_subscription_count() > 0)
        scans = peer.got[topics.FREE_SCAN]
        count = len(scans)
        peer.send(stamp, POSE, IMAGE, run)
        assert ros.spin_until(lambda: len(scans) > count)
        assert conversions.stamp_of(scans[-1].header.stamp) == stamp
        return node

    def test_the_next_one_has_the_map_and_the_rocks(self, ros):
        peer = Peer(ros)
        before = self.drive_and_end(ros, peer)
        node = self.again(ros, peer, self.RUN, self.last + 40_000_000)
        after_ = node._core.world_map()
        assert np.count_nonzero(before.cells >= 0) > 50
        assert (after_.cells >= 0)[before.cells >= 0].mean() > 0.95  # that frame says more
        assert self.tracks
        assert node._core.memory()()[0]["rocks"]["tracks"] == self.tracks

    @pytest.mark.parametrize(
        "run, later",
        [(Run(5, 9_000_000_000), 9_000_000_000), (RUN, RUN.start)],
        ids=["another run", "before what was saved"],
    )
    def test_a_frame_of_another_run_starts_with_an_empty_map(self, ros, run, later):
        peer = Peer(ros)
        before = self.drive_and_end(ros, peer)
        node = self.again(ros, peer, run, later)
        assert (node._core.world_map().cells >= 0)[before.cells >= 0].mean() < 0.8
