"""The perception node: images and poses to a world map, polar arrays and rocks.

Subscribes camera/image_raw, odom and rover_status (joined by stamp), and /diagnostics. Publishes
nav_polar, rock_polar, free_scan and rocks (latched) for every frame; worldmap (latched) at the map
period; navigation_map (latched), vision_image and birdseye_image only while subscribed;
/diagnostics.
Parameters: see PerceptionConfig and InputLimits. The whole contract is in the package's README.
"""

from __future__ import annotations

import time
from typing import Any

import cv2
import numpy as np
from nav_msgs.msg import OccupancyGrid, Odometry
from numpy.typing import NDArray
from rclpy.clock import Clock, ClockType
from rclpy.publisher import Publisher
from rover_interfaces.msg import PolarArray, RockTrackArray, RoverStatus
from sensor_msgs.msg import Image, LaserScan

from rover_common import nodes, topics
from rover_common.frames import FrameConfig
from rover_common.input_monitor import Input, InputLimits, InputMonitor
from rover_common.ros import conversions, qos, scan_conversions
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.diagnostics import NodeDiagnostics, input_of
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.ros.state import NodeState
from rover_common.ros.sync import ExactTimeSynchronizer
from rover_common.saved_state import SavedState
from rover_common.state_keeper import MakeState
from rover_common.types import PerceptionResult, Run
from rover_perception.config import PerceptionConfig
from rover_perception.factory import make_perception
from rover_perception.frame_validation import FrameError

# Counters in /diagnostics, beside those of FrameError's subclasses.
FRAMES = "frames"
FRAMES_INCOMPLETE = "frames_incomplete"

VERSION = 1  # of what is saved
LOG_PERIOD = 5.0  # [s] between two lines about dropped frames
PAUSE = 0.2  # [s] of wall time without a frame after which the map is brought up to date


class PerceptionNode(CheckedNode):
    """Joins the parts of a frame, calls the core once per frame and publishes its result."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("perception_node", **kwargs)
        cv2.setNumThreads(1)  # the images are small, and the other nodes need the cores
        self._frames = declare_parameters(self, FrameConfig).frames()
        self._config = declare_parameters(self, PerceptionConfig, self._on_config)
        self._core = make_perception(self._config)
        kind = f"perception {self._config.recipe}"
        self._state = NodeState(self, self._config.state_dir, kind, VERSION)
        self._newest: tuple[Run, int] | None = None  # run and stamp [ns] of the last frame
        self._join = ExactTimeSynchronizer((topics.IMAGE, topics.ODOMETRY, topics.STATUS))
        self._stamp: int | None = None
        self._optical = ""  # frame of the images
        self._map_stamp: int | None = None
        self._maps_due = False  # those that include the last frame
        self._navigation_map_missed = False  # nobody listened when it was due
        self._picture_stamps: dict[str, int] = {}  # [ns] by topic
        self._frames_at_last_check = 0
        self._make_endpoints()
        self._pause_timer = self.create_timer(
            PAUSE, self._on_pause_check, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )

    def _make_endpoints(self) -> None:
        publish = self.create_publisher
        self.expect_frames({topics.ODOMETRY: self._frames.odom})
        self._nav = publish(PolarArray, topics.NAV_POLAR, qos.FRAME)
        self._rock_polar = publish(PolarArray, topics.ROCK_POLAR, qos.FRAME)
        self._scan = publish(LaserScan, topics.FREE_SCAN, qos.FRAME)
        self._rock_list = publish(RockTrackArray, topics.ROCKS, qos.FRAME_LATCHED)
        self._map = publish(OccupancyGrid, topics.WORLDMAP, qos.LATCHED)
        self._navigation_map = publish(OccupancyGrid, topics.NAVIGATION_MAP, qos.LATCHED)
        self._vision = publish(Image, topics.VISION_IMAGE, qos.VIEW)
        self._birdseye = publish(Image, topics.BIRDSEYE_IMAGE, qos.VIEW)
        image = self.create_subscription(Image, topics.IMAGE, self._on_image, qos.FRAME)
        odometry = self.create_subscription(Odometry, topics.ODOMETRY, self._on_odometry, qos.FRAME)
        status = self.create_subscription(RoverStatus, topics.STATUS, self._on_status, qos.FRAME)
        peers = {
            "bridge": lambda: (
                image.get_publisher_count() > 0
                and odometry.get_publisher_count() > 0
                and status.get_publisher_count() > 0
            ),
            "decision": lambda: (
                self._nav.get_subscription_count() > 0 and self._scan.get_subscription_count() > 0
            ),
        }
        limits = declare_parameters(self, InputLimits)
        sent = {topics.IMAGE: image, topics.ODOMETRY: odometry, topics.STATUS: status}
        inputs = [input_of(topic, each, nodes.BRIDGE) for topic, each in sent.items()]
        self._inputs = InputMonitor([*inputs, Input(FRAMES)], limits)
        self._diagnostics = NodeDiagnostics(self, peers, self._inputs)
        self._diagnostics.join(nodes.ROVER, limits.input_error_age)

    def _on_config(self, config: PerceptionConfig) -> None:
        self._config = config

    def _on_image(self, message: Image) -> None:
        self._on_part(topics.IMAGE, message)

    def _on_odometry(self, message: Odometry) -> None:
        self._on_part(topics.ODOMETRY, message)

    def _on_status(self, message: RoverStatus) -> None:
        self._on_part(topics.STATUS, message)

    def _on_part(self, topic: str, message: Any) -> None:
        now, before = time.monotonic(), self._join.dropped
        self._inputs.note(topic, now)
        parts = self._join.add(topic, conversions.stamp_of(message.header.stamp), message)
        self._diagnostics.counts[FRAMES_INCOMPLETE] = self._join.dropped
        if self._join.dropped > before:
            self._inputs.drop(FRAMES, now, "incomplete", self._join.dropped - before)
        if parts is None:
            return
        self._publish_due_maps()
        self._optical = parts[topics.IMAGE].header.frame_id
        try:
            frame = conversions.camera_frame_of(
                parts[topics.IMAGE], parts[topics.ODOMETRY], parts[topics.STATUS]
            )
            self._state.resume(frame.run, frame.stamp, self._resume)
            with self._diagnostics.ticks:
                result = self._core.process(frame)
        except FrameError as error:
            self._drop(error.counter, error)
        else:
            self._diagnostics.counts[FRAMES] += 1
            self._inputs.note(FRAMES, now)
            self._publish(result)
            self._newest = result.run, result.stamp
            self._state.keep(self._snapshot)

    def _resume(self, saved: SavedState) -> None:
        self._core.resume(saved.run, (saved.values, saved.arrays))

    def _snapshot(self) -> MakeState:
        """Of the map and the rocks as they are now."""
        assert self._newest is not None
        (run, stamp), memory = self._newest, self._core.memory()
        return lambda: SavedState(run, stamp, *memory())

    def destroy_node(self) -> None:
        """Save the last state, and end the thread that does, then the node."""
        if hasattr(self, "_state"):
            self._state.close(None if self._newest is None else self._snapshot)
        super().destroy_node()

    def _drop(self, counter: str, error: Exception) -> None:
        self._diagnostics.counts[counter] += 1
        self._inputs.drop(FRAMES, time.monotonic(), str(error))
        self.get_logger().warning(f"frame dropped: {error}", throttle_duration_sec=LOG_PERIOD)

    def _publish(self, result: PerceptionResult) -> None:
        """What the decision node waits for goes first."""
        stamp, run, frames = result.stamp, result.run, self._frames
        rocks = conversions.rocks_message_of(stamp, run, result.rocks, result.map_stamp, frames)
        self._rock_list.publish(rocks)
        self._nav.publish(scan_conversions.polar_message_of(stamp, run, result.nav, frames))
        self._rock_polar.publish(scan_conversions.polar_message_of(stamp, run, result.rock, frames))
        self._scan.publish(scan_conversions.scan_message_of(stamp, result.scan, frames))
        self._stamp = stamp
        self._maps_due = result.map_stamp == stamp
        self._publish_pictures(stamp)

    def _publish_due_maps(self) -> None:
        """Maps follow when the next frame has come: all have read the messages of theirs by then.

        A navigation map is larger than a segment of Fast DDS's shared memory: published at once, it
        overwrites the small messages before it, and their repair takes up to 3 s.
        """
        if self._maps_due and self._stamp is not None:
            self._maps_due = False
            self._publish_map(self._stamp)
            self._publish_navigation_map(self._stamp)

    def _publish_map(self, stamp: int) -> None:
        self._map_stamp = stamp
        grid = self._core.world_map()
        self._map.publish(conversions.grid_message_of(stamp, grid, self._frames))

    def _publish_navigation_map(self, stamp: int) -> None:
        """Only while subscribed: its message is sixteen times as large as the world map's."""
        self._navigation_map_missed = not self._navigation_map.get_subscription_count()
        if not self._navigation_map_missed:
            grid = self._core.navigation_map()
            message = conversions.grid_message_of(stamp, grid, self._frames)
            self._navigation_map.publish(message)

    def _publish_pictures(self, stamp: int) -> None:
        """Those that somebody has subscribed, at most one per vision period each."""
        if self._picture_due(self._vision, stamp):
            self._publish_picture(self._vision, self._optical, self._core.vision_image())
        if self._picture_due(self._birdseye, stamp):
            base = self._frames.base
            self._publish_picture(self._birdseye, base, self._core.birdseye_image())

    def _publish_picture(
        self, publisher: Publisher, frame: str, picture: NDArray[np.uint8] | None
    ) -> None:
        if picture is not None:
            stamp = self._picture_stamps[publisher.topic]
            publisher.publish(conversions.image_message_of(stamp, frame, picture))

    def _picture_due(self, publisher: Publisher, stamp: int) -> bool:
        """Whether it is subscribed and its period has passed; the next one counts from now then."""
        last = self._picture_stamps.get(publisher.topic)
        due = publisher.get_subscription_count() and _due(last, stamp, self._config.vision_period)
        if due:
            self._picture_stamps[publisher.topic] = stamp
        return bool(due)

    def _on_pause_check(self) -> None:
        """When no frames arrive, publish the world map that includes the last one.

        Not the navigation map, unless nobody listened when it was due: plans are made of the maps
        that were due, so that a mission is the same however long a frame takes.
        """
        frame_count = self._diagnostics.counts[FRAMES]
        paused = frame_count == self._frames_at_last_check
        self._frames_at_last_check = frame_count
        if not paused or self._stamp is None:
            return
        self._publish_due_maps()
        if self._map_stamp != self._stamp:
            self._publish_map(self._stamp)
        if self._navigation_map_missed:
            self._publish_navigation_map(self._stamp)


def _due(last: int | None, now: int, period: float) -> bool:
    """Whether two stamps [ns] are a period [s] of frame time apart, in either direction."""
    return last is None or abs(now - last) >= period * 1e9


def main() -> None:
    """Entry point of `ros2 run rover_perception perception_node`."""
    run_node(PerceptionNode, keeps_maps=True)
