"""The perception node in process."""

from typing import Any

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rover_interfaces.msg import PolarArray, RockTrackArray
from scene import draw
from sensor_msgs.msg import Image, LaserScan

from rover_common import frames, topics
from rover_common.geometry import Pose
from rover_common.map_encoding import navigable_cells
from rover_common.ros import conversions, qos
from rover_perception import node as perception_node
from rover_perception.node import PerceptionNode

POSE = Pose(90.0, 100.0, 0.0)
IMAGE = draw(POSE, lambda x, y: (y > 95) & (y < 105))


class Bench:
    """A perception node, its input by hand and its output in lists."""

    def __init__(self, ros) -> None:
        self.ros = ros
        self.node = ros.add(PerceptionNode, image_lag=0)
        self.peer = ros.add(lambda **kwargs: Node("peer", **kwargs))
        self._image = self.peer.create_publisher(Image, topics.IMAGE, qos.FRAME)
        self._odometry = self.peer.create_publisher(Odometry, topics.ODOMETRY, qos.FRAME)
        self.got: dict[str, list[Any]] = {}
        self.listen(PolarArray, topics.NAV_POLAR, qos.FRAME)
        self.listen(PolarArray, topics.ROCK_POLAR, qos.FRAME)
        self.listen(LaserScan, topics.FREE_SCAN, qos.FRAME)
        assert ros.spin_until(lambda: self._image.get_subscription_count() > 0)
        assert ros.spin_until(lambda: self._odometry.get_subscription_count() > 0)
        assert ros.spin_until(lambda: self.node.count_subscribers(topics.FREE_SCAN) > 0)

    def listen(self, kind: type, topic: str, profile: Any) -> list[Any]:
        self.got[topic] = []
        self.peer.create_subscription(kind, topic, self.got[topic].append, profile)
        return self.got[topic]

    def send(self, stamp: int, pose: Pose = POSE, image: np.ndarray = IMAGE, **fields: Any) -> None:
        message = conversions.image_message_of(stamp, frames.CAMERA_OPTICAL, image)
        for name, value in fields.items():
            setattr(message, name, value)
        self._image.publish(message)
        self._odometry.publish(conversions.odometry_of(stamp, pose, 0.0))


@pytest.fixture
def bench(ros):
    return Bench(ros)


def test_each_frame_gives_its_three_arrays_with_its_stamp(ros, bench):
    for stamp in (1_000_000_000, 1_040_000_000):
        bench.send(stamp)
        assert ros.spin_until(
            lambda stamp=stamp: all(
                messages and conversions.stamp_of(messages[-1].header.stamp) == stamp
                for messages in bench.got.values()
            )
        )
    assert len(bench.got[topics.NAV_POLAR][0].ranges) > 50


def test_a_late_subscriber_gets_the_map_and_the_last_frame_is_in_it(ros, bench):
    for index in range(5):
        bench.send(1_000_000_000 + index * 40_000_000)
        assert ros.spin_until(lambda index=index: len(bench.got[topics.FREE_SCAN]) == index + 1)
    grids = bench.listen(OccupancyGrid, topics.WORLDMAP, qos.LATCHED)
    last = 1_000_000_000 + 4 * 40_000_000
    assert ros.spin_until(lambda: grids and conversions.stamp_of(grids[-1].header.stamp) == last)
    grid = grids[-1]
    assert (grid.info.width, grid.info.height, grid.info.resolution) == (200, 200, 1.0)
    assert grid.header.frame_id == "map"
    cells = np.array(grid.data).reshape(200, 200)
    assert (cells[99:101, 92:94] >= 0).all()
    assert (cells[99:101, 92:94] < 50).all()


def test_the_navigation_map_is_the_same_map_in_finer_cells(ros, bench):
    grids = bench.listen(OccupancyGrid, topics.NAVIGATION_MAP, qos.LATCHED)
    for index in range(5):
        bench.send(1_000_000_000 + index * 40_000_000)
    last = 1_000_000_000 + 4 * 40_000_000
    assert ros.spin_until(lambda: grids and conversions.stamp_of(grids[-1].header.stamp) == last)
    grid = grids[-1]
    assert (grid.info.width, grid.info.height, grid.info.resolution) == (800, 800, 0.25)
    cells = np.array(grid.data).reshape(800, 800)
    assert (cells[396:404, 366:374] == 0).all()
    assert (cells[:376] != 0).all()  # beyond the wall


def test_bad_frames_are_dropped_and_a_diagnostic_says_so(ros, bench):
    reports = bench.listen(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    counts = bench.node._diagnostics.counts
    faults: dict[str, dict[str, Any]] = {
        "frame_image_encoding": {"encoding": "bgr8"},
        "frame_pose_not_finite": {"pose": Pose(float("nan"), 0.0, 0.0)},
        "frame_image_size": {"image": np.zeros((10, 10, 3), np.uint8)},
        "frame_pose_outside": {"pose": Pose(-3.0, 100.0, 0.0)},
        "frames": {},
    }
    for index, (counter, fault) in enumerate(faults.items()):
        bench.send(1_000_000_000 + index * 40_000_000, **fault)
        assert ros.spin_until(lambda counter=counter: counts[counter] == 1)
    assert len(bench.got[topics.FREE_SCAN]) <= 1
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
def test_black_and_white_pictures_leave_the_map_as_it_was(ros, bench, level):
    def wait(stamp: int) -> None:
        scans = bench.got[topics.FREE_SCAN]
        assert ros.spin_until(
            lambda: scans and conversions.stamp_of(scans[-1].header.stamp) == stamp
        )

    def free() -> np.ndarray:
        return navigable_cells(bench.node._core.world_map().cells)

    stamps = iter(range(1_000_000_000, 9_000_000_000, 40_000_000))
    for _ in range(10):
        bench.send(stamp := next(stamps))
        wait(stamp)
    before = free()
    for _ in range(3):
        bench.send(stamp := next(stamps), image=np.full((160, 320, 3), level, np.uint8))
        wait(stamp)
    assert before.any()
    assert (free() | ~before)[99:101, 92:].all()
    gained = np.argwhere(free() & ~before)
    # All white is ground up to the horizon: a slope, of which the nearest 4 m are taken.
    assert (np.hypot(gained[:, 1] + 0.5 - POSE.x, gained[:, 0] + 0.5 - POSE.y) < 6.0).all()


def test_time_that_goes_backwards_is_survived_and_a_new_run_is_told_of(ros, bench):
    reports = bench.listen(DiagnosticArray, "/diagnostics", qos.DIAGNOSTICS)
    scans = bench.got[topics.FREE_SCAN]
    for count, stamp in enumerate((60_000_000_000, 59_000_000_000, 1_000_000_000), start=1):
        bench.send(stamp)
        assert ros.spin_until(lambda count=count: len(scans) == count)
    told = {"frames": "3", "map_restarts": "1"}
    assert ros.spin_until(lambda: told.items() <= last_report(reports).items())


def test_nobody_paints_a_vision_image_that_nobody_sees(ros, bench, monkeypatch):
    painted = []
    monkeypatch.setattr(perception_node, "vision_image", painted.append)
    for index in range(3):
        bench.send(1_000_000_000 + index * 300_000_000)
        assert ros.spin_until(lambda index=index: len(bench.got[topics.FREE_SCAN]) == index + 1)
    assert painted == []


def test_the_vision_image_is_made_for_subscribers(ros, bench):
    bench.listen(RockTrackArray, topics.ROCKS, qos.LATCHED)
    pictures = bench.listen(Image, topics.VISION_IMAGE, qos.VIEW)
    assert ros.spin_until(lambda: bench.node.count_subscribers(topics.VISION_IMAGE) > 0)
    stamps = iter(range(1_000_000_000, 60_000_000_000, 300_000_000))

    def shown() -> bool:
        bench.send(next(stamps))
        return bool(pictures)

    assert ros.spin_until(shown)
    picture = conversions.image_of(pictures[0])
    assert picture.shape == (160, 320, 3)
    assert picture[150, 160, 2] > picture[150, 160, 0]  # ground is shown in blue
