"""Draws the insets beside the bridge, in a thread and a node of their own.

The path of an answer has no part in it but for a look into the box of finished pictures. The node
is there while the active client shows insets. Nothing spins it: its thread takes the newest message
of each topic when it draws. Subscribes worldmap, rocks and birdseye_image.
"""

from __future__ import annotations

import threading
from collections import deque
from functools import partial
from typing import Any

import numpy as np
from nav_msgs.msg import OccupancyGrid
from numpy.typing import NDArray
from rclpy._rclpy_pybind11 import RCLError
from rclpy.exceptions import NotInitializedException
from rclpy.parameter import Parameter
from rover_interfaces.msg import RockTrackArray
from sensor_msgs.msg import Image

from rover_bridge.codec import shows_insets
from rover_bridge.config import BridgeConfig
from rover_bridge.insets import NO_INSETS, Insets, MapScene, encode_inset, map_inset
from rover_common import topics
from rover_common.geometry import Pose, distance_between
from rover_common.ros import qos
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.conversions import MessageError, grid_of, image_of, rocks_of, stamp_of
from rover_common.types import Run

INPUTS = (
    (topics.WORLDMAP, OccupancyGrid, qos.LATCHED),
    (topics.ROCKS, RockTrackArray, qos.LATCHED),
    (topics.BIRDSEYE_IMAGE, Image, qos.VIEW),
)
TRACK_STEP = 0.5  # [m] between two points of the drawn track: a pixel
MOST_POSES = 10_000  # that wait for the next picture; a slow drawing loses the oldest
STOP_SECONDS = 5.0  # [s] until the thread has ended
LOG_PERIOD = 5.0  # [s] between two lines about pictures that cannot be made


class InsetNode(CheckedNode):
    """Holds the newest message of each topic that can be used; the bridge counts the others."""

    def __init__(self, bridge: CheckedNode, map_frame: str) -> None:
        super().__init__(
            f"{bridge.get_name()}_insets",
            context=bridge.context,
            namespace=bridge.get_namespace(),
            use_global_arguments=False,  # a new name for the bridge is none for this node
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
            start_parameter_services=False,
            enable_rosout=False,
        )
        self.counts = bridge.counts
        self.expect_frames({topics.WORLDMAP: map_frame, topics.ROCKS: map_frame})
        self._newest: dict[str, Any] = {}
        self._inputs = {
            topic: self.create_subscription(
                kind, bridge.resolve_topic_name(topic), partial(self._store, topic), profile
            )
            for topic, kind, profile in INPUTS
        }

    def newest(self, topic: str) -> Any:
        """The newest message of a topic, None before the first one."""
        subscription = self._inputs[topic]
        with subscription.handle:
            taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
        if taken is not None:
            subscription.callback(taken[0])
        return self._newest.get(topic)

    def _store(self, topic: str, message: Any) -> None:
        self._newest[topic] = message


class InsetDrawer:
    """Makes a pair of insets per period while the active client shows them.

    All methods but those of the thread are called in the bridge's thread and return at once.
    """

    def __init__(
        self,
        bridge: CheckedNode,
        config: BridgeConfig,
        truth: NDArray[np.bool_] | None,
        map_frame: str,
    ) -> None:
        self._bridge, self._map_frame = bridge, map_frame
        self._mode, self._period, self._truth = config.insets, config.inset_period, truth
        self._client: str | None = None  # the active client, if it shows insets
        self._poses: deque[tuple[Run, Pose]] = deque(maxlen=MOST_POSES)
        self._finished: deque[Insets] = deque(maxlen=1)  # the pair that was not sent yet
        self._shown, self._ended = threading.Event(), threading.Event()
        self._thread: threading.Thread | None = None
        self._run: Run | None = None  # this and what follows belongs to the thread
        self._pose: Pose | None = None
        self._track: list[Pose] = []

    def configure(self, config: BridgeConfig) -> None:
        """From the next telemetry and the next pair on."""
        self._mode, self._period = config.insets, config.inset_period

    def follow(self, client: str, wire: object, run: Run, pose: Pose) -> None:
        """A telemetry of the active client."""
        if self._mode == "never" or (self._mode == "auto" and not shows_insets(wire)):
            self.leave()
            return
        self._poses.append((run, pose))
        if client == self._client:
            return
        self._client = client
        self._shown.set()
        if self._thread is None:
            self._thread = threading.Thread(target=self._draw_on, name="insets", daemon=True)
            self._thread.start()

    def leave(self) -> None:
        """The active client has left, or does not show insets."""
        if self._client is not None:
            self._client = None
            self._shown.clear()

    def take(self, client: str) -> Insets:
        """The newest pair for an answer to this client; each pair is sent once."""
        if client != self._client:
            return NO_INSETS
        try:
            return self._finished.pop()
        except IndexError:
            return NO_INSETS

    def close(self) -> None:
        """End the thread, and its node."""
        self._ended.set()
        self._shown.set()
        if self._thread is not None:
            self._thread.join(STOP_SECONDS)

    def _draw_on(self) -> None:
        """The thread: a node while a client shows insets."""
        while self._shown.wait() and not self._ended.is_set():
            try:
                node = InsetNode(self._bridge, self._map_frame)
                try:
                    self._draw_pairs(node)
                finally:
                    node.destroy_node()
                    self._finished.clear()
            except (RCLError, NotInitializedException):
                if self._bridge.context.ok():  # otherwise it is the race with the shutdown
                    raise
                return

    def _draw_pairs(self, node: InsetNode) -> None:
        while self._shown.is_set() and not self._ended.wait(self._period):
            self._follow_track()
            if self._pose is None:
                continue
            try:
                self._draw(node, self._pose)
            except MessageError as error:
                self._bridge.get_logger().warning(
                    f"no insets: {error}", throttle_duration_sec=LOG_PERIOD
                )

    def _draw(self, node: InsetNode, pose: Pose) -> None:
        picture = node.newest(topics.BIRDSEYE_IMAGE)
        birdseye = "" if picture is None else encode_inset(image_of(picture))
        self._finished.append(Insets(encode_inset(map_inset(self._scene(node, pose))), birdseye))

    def _scene(self, node: InsetNode, pose: Pose) -> MapScene:
        """Of the present run alone: the newest messages may be of the run before."""
        run = self._run
        assert run is not None
        grid, rocks = node.newest(topics.WORLDMAP), node.newest(topics.ROCKS)
        mapped = grid is not None and run.holds(stamp_of(grid.header.stamp))
        found = rocks_of(rocks) if rocks is not None and rocks.run == run.number else ()
        return MapScene(
            pose=pose,
            grid=grid_of(grid) if mapped else None,
            truth=self._truth,
            track=np.array([(point.x, point.y) for point in [*self._track, pose]]),
            rocks=np.array([(rock.x, rock.y) for rock in found]).reshape(-1, 2),
        )

    def _follow_track(self) -> None:
        """Add the poses since the last picture to the track of the run."""
        while self._poses:
            run, self._pose = self._poses.popleft()
            if self._run is None or run.number != self._run.number:
                self._track = []
            self._run = run
            if not self._track or distance_between(self._track[-1], self._pose) >= TRACK_STEP:
                self._track.append(self._pose)
