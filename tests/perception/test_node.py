"""The perception node in process."""

from typing import Any

import numpy as np
import pytest
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rover_interfaces.msg import PolarArray, RockDetectionArray
from scene import draw
from sensor_msgs.msg import Image, LaserScan

from rover_common import conversions, frames, qos, topics
from rover_common.geometry import Pose
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


def test_the_driving_map_is_the_same_map_in_finer_cells(ros, bench):
    grids = bench.listen(OccupancyGrid, topics.DRIVING_MAP, qos.LATCHED)
    for index in range(5):
        bench.send(1_000_000_000 + index * 40_000_000)
    last = 1_000_000_000 + 4 * 40_000_000
    assert ros.spin_until(lambda: grids and conversions.stamp_of(grids[-1].header.stamp) == last)
    grid = grids[-1]
    assert (grid.info.width, grid.info.height, grid.info.resolution) == (800, 800, 0.25)
    cells = np.array(grid.data).reshape(800, 800)
    assert (cells[396:404, 366:374] == 0).all()
    assert (cells[:376] != 0).all()  # beyond the wall


def test_bad_frames_are_dropped_and_counted(ros, bench):
    bench.send(1_000_000_000, encoding="bgr8")
    bench.send(1_040_000_000, pose=Pose(float("nan"), 0.0, 0.0))
    bench.send(1_080_000_000, image=np.zeros((10, 10, 3), np.uint8))
    bench.send(1_120_000_000)
    assert ros.spin_until(lambda: bench.got[topics.FREE_SCAN])
    counts = bench.node._diagnostics.counts
    assert counts["frames"] == 1
    assert counts["frame_image_encoding"] == 1
    assert counts["frame_pose_not_finite"] == 1
    assert counts["frame_image_size"] == 1


def test_the_vision_image_is_made_for_subscribers(ros, bench):
    bench.listen(RockDetectionArray, topics.ROCKS, qos.LATCHED)
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
