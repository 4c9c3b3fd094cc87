"""The perception node in process."""

from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid
from node_peer import POSE, Peer
from rover_interfaces.msg import RockTrackArray
from scene import draw
from sensor_msgs.msg import Image

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.map_encoding import navigable_cells
from rover_common.ros import conversions, qos
from rover_common.types import FIRST_RUN, Run
from rover_perception import perception


@pytest.fixture
def peer(ros):
    return Peer(ros)


def test_each_frame_gives_its_arrays_with_its_stamp(ros, peer):
    for stamp in (1_000_000_000, 1_040_000_000):
        peer.send(stamp)
        assert ros.spin_until(
            lambda stamp=stamp: all(
                messages and conversions.stamp_of(messages[-1].header.stamp) == stamp
                for messages in peer.got.values()
            )
        )
    assert len(peer.got[topics.NAV_POLAR][0].ranges) > 50


def test_incomplete_frames_are_dropped_and_counted(ros, peer):
    counts = peer.node._diagnostics.counts
    stamps = iter(range(1_000_000_000, 9_000_000_000, 40_000_000))

    def counted() -> bool:
        peer._odometry.publish(conversions.odometry_of(next(stamps), POSE, 0.0))
        return counts["frames_incomplete"] > 0

    assert ros.spin_until(counted)
    assert counts["frames"] == 0


def test_a_late_subscriber_gets_the_map_that_includes_the_last_frame(ros, peer):
    for index in range(5):
        peer.send(1_000_000_000 + index * 40_000_000)
        assert ros.spin_until(lambda index=index: len(peer.got[topics.FREE_SCAN]) == index + 1)
    grids = peer.listen(OccupancyGrid, topics.WORLDMAP, qos.LATCHED)
    last = 1_000_000_000 + 4 * 40_000_000
    assert ros.spin_until(lambda: grids and conversions.stamp_of(grids[-1].header.stamp) == last)
    grid = grids[-1]
    assert (grid.info.width, grid.info.height, grid.info.resolution) == (200, 200, 1.0)
    assert grid.header.frame_id == "map"
    cells = np.array(grid.data).reshape(200, 200)
    assert (cells[99:101, 92:94] >= 0).all()
    assert (cells[99:101, 92:94] < 50).all()


def test_the_navigation_map_is_the_same_map_in_finer_cells(ros, peer):
    grids = peer.listen(OccupancyGrid, topics.NAVIGATION_MAP, qos.LATCHED)
    for index in range(5):
        peer.send(1_000_000_000 + index * 40_000_000)
    assert ros.spin_until(lambda: grids)
    grid = grids[-1]
    assert (grid.info.width, grid.info.height, grid.info.resolution) == (800, 800, 0.25)
    cells = np.array(grid.data).reshape(800, 800)
    assert (cells[396:404, 366:374] == 0).all()
    assert (cells[:376] != 0).all()  # beyond the wall


def test_a_pause_makes_no_navigation_map_that_was_not_due(ros, peer):
    """Else a mission in which a frame takes long would be driven by other plans."""
    fine = peer.listen(OccupancyGrid, topics.NAVIGATION_MAP, qos.LATCHED)
    coarse = peer.listen(OccupancyGrid, topics.WORLDMAP, qos.LATCHED)
    first, second = 1_000_000_000, 1_040_000_000
    scans = peer.got[topics.FREE_SCAN]
    for stamp in (first, second):
        peer.send(stamp)
        assert ros.spin_until(
            lambda stamp=stamp: scans and conversions.stamp_of(scans[-1].header.stamp) == stamp
        )
    assert ros.spin_until(
        lambda: coarse and conversions.stamp_of(coarse[-1].header.stamp) == second
    )
    assert [conversions.stamp_of(grid.header.stamp) for grid in fine] == [first]


def test_a_navigation_map_that_nobody_heard_comes_after_a_pause(ros, peer):
    peer.send(1_000_000_000)
    assert ros.spin_until(lambda: peer.node._navigation_map_missed)
    assert ros.spin_until(peer.listen(OccupancyGrid, topics.NAVIGATION_MAP, qos.LATCHED).copy)


def test_invalid_frames_are_dropped_and_counted_in_the_diagnostics(ros, peer):
    reports = peer.listen(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    counts = peer.node._diagnostics.counts
    faults: dict[str, dict[str, Any]] = {
        "frame_image_encoding": {"encoding": "bgr8"},
        "frame_pose_not_finite": {"pose": Pose(float("nan"), 0.0, 0.0)},
        "frame_image_size": {"image": np.zeros((10, 10, 3), np.uint8)},
        "frame_pose_outside": {"pose": Pose(-3.0, 100.0, 0.0)},
        "frames": {},
    }
    for index, (counter, fault) in enumerate(faults.items()):
        peer.send(1_000_000_000 + index * 40_000_000, **fault)
        assert ros.spin_until(lambda counter=counter: counts[counter] == 1)
    assert len(peer.got[topics.FREE_SCAN]) <= 1
    told = dict.fromkeys(faults, "1")
    assert ros.spin_until(lambda: told.items() <= last_report(reports).items())


def last_report(reports: list[DiagnosticArray]) -> dict[str, str]:
    """The perception node's counters as they were last published."""
    own = [
        status
        for report in reports
        for status in report.status
        if status.name.endswith("perception_node")
    ]
    return {pair.key: pair.value for pair in own[-1].values} if own else {}


@pytest.mark.parametrize("level", [0, 255])
def test_black_and_white_images_keep_the_free_cells_of_the_map(ros, peer, level):
    def wait(stamp: int) -> None:
        scans = peer.got[topics.FREE_SCAN]
        assert ros.spin_until(
            lambda: scans and conversions.stamp_of(scans[-1].header.stamp) == stamp
        )

    def free() -> np.ndarray:
        return navigable_cells(peer.node._core.world_map().cells)

    stamps = iter(range(1_000_000_000, 9_000_000_000, 40_000_000))
    for _ in range(10):
        peer.send(stamp := next(stamps))
        wait(stamp)
    before = free()
    for _ in range(3):
        peer.send(stamp := next(stamps), image=np.full((160, 320, 3), level, np.uint8))
        wait(stamp)
    assert before.any()
    assert (free() | ~before)[99:101, 92:].all()
    gained = np.argwhere(free() & ~before)
    # All white is ground up to the horizon: a slope, of which the nearest 4 m are taken.
    assert (np.hypot(gained[:, 1] + 0.5 - POSE.x, gained[:, 0] + 0.5 - POSE.y) < 6.0).all()


def test_a_new_run_starts_a_new_map_and_its_messages_carry_its_number(ros, peer):
    def send(stamp: int, run: Run, pose: Pose) -> None:
        peer.send(stamp, pose, draw(pose, lambda x, y: x < pose.x + 8), run)
        assert ros.spin_until(
            lambda: all(
                messages and conversions.stamp_of(messages[-1].header.stamp) == stamp
                for messages in peer.got.values()
            )
        )

    rocks = peer.listen(RockTrackArray, topics.ROCKS, qos.FRAME_LATCHED)
    grids = peer.listen(OccupancyGrid, topics.WORLDMAP, qos.LATCHED)
    assert ros.spin_until(lambda: peer.node.count_subscribers(topics.WORLDMAP) > 0)
    send(1_000_000_000, FIRST_RUN, POSE)
    second = Run(2, 1_040_000_000)
    send(second.start, second, Pose(20.0, 20.0, 0.0))  # a map is due, whatever the map period
    assert [message.run for message in rocks] == [1, 2]
    for topic in (topics.NAV_POLAR, topics.ROCK_POLAR):
        assert [message.run for message in peer.got[topic]] == [1, 2]
    assert conversions.stamp_of(rocks[-1].map_stamp) == second.start
    before, after = (np.array(grid.data).reshape(200, 200) for grid in grids)
    assert (before[90:110] >= 0).any()
    assert (after[90:110] == -1).all()
    assert (after[15:25] >= 0).any()


@pytest.mark.parametrize("picture", ["vision_image", "birdseye_image"])
def test_a_picture_is_not_drawn_without_a_subscriber(ros, peer, monkeypatch, picture):
    drawn = []
    monkeypatch.setattr(perception, picture, lambda *values: drawn.append(values))
    for index in range(3):
        peer.send(1_000_000_000 + index * 300_000_000)
        assert ros.spin_until(lambda index=index: len(peer.got[topics.FREE_SCAN]) == index + 1)
    assert drawn == []


@pytest.mark.parametrize(
    ("topic", "frame"),
    [(topics.VISION_IMAGE, frames.CAMERA_OPTICAL), (topics.BIRDSEYE_IMAGE, frames.BASE)],
)
def test_a_picture_is_published_for_subscribers(ros, peer, topic, frame):
    images = peer.listen(Image, topic, qos.VIEW)
    assert ros.spin_until(lambda: peer.node.count_subscribers(topic) > 0)
    stamps = iter(range(1_000_000_000, 60_000_000_000, 300_000_000))
    assert ros.spin_until(lambda: images or peer.send(next(stamps)))
    image = conversions.image_of(images[0])
    assert images[0].header.frame_id == frame
    assert image.shape == (160, 320, 3)
    assert image[140, 160, 2] > image[140, 160, 0]  # ground is shown in blue
