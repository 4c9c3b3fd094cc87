"""The recorder node: every topic of the graph into a file.

Subscribes every topic that somebody publishes, but hidden ones, whose name has a part that begins
with `_`; of an image topic its `/compressed` one where there is one. Messages are written as they
are on the wire, other images as JPEG. Publishes /diagnostics. Parameters: RecorderConfig.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import Any

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.serialization import serialize_message
from rclpy.signals import SignalHandlerOptions
from rclpy.subscription import Subscription
from sensor_msgs.msg import Image

from rover_common import topics
from rover_common.errors import RoverError
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.conversions import stamp_of
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.fast_dds import use_patient_profiles
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.priority import give_way
from rover_common.ros.runner import (
    EventsExecutor,
    StopSignals,
    spin_for,
    start_errors,
    start_ros,
)
from rover_recorder import bag
from rover_recorder.config import RecorderConfig
from rover_recorder.conversions import (
    compressed_of,
    qos_words,
    stamp_in,
    subscription_profile,
    type_of,
)
from rover_recorder.errors import RecordingError
from rover_recorder.node_listener import KnownListener
from rover_recorder.schemas import begins_with_stamp, definition
from rover_recorder.types import Topic
from rover_recorder.writer import RecordingWriter

SEARCH_PERIOD = 0.5  # [s] between two looks for new topics
FLUSH_PERIOD = 1.0  # [s] a kill loses at most as much
LAST_SECONDS = 0.3  # [s] for what was published before the end to arrive
IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
# The graph is recorded when these are: what a replay needs, and what each node makes.
SENSING = {
    "bridge": (topics.COMPRESSED_IMAGE, topics.ODOMETRY, topics.STATUS),
    "perception": (topics.WORLDMAP, topics.ROCKS),
}
NEEDED = {
    "rover": SENSING | {"decision": (topics.COMMAND, topics.MISSION_STATE)},
    "drive": SENSING,
    "heat": {
        "robot": (topics.SCAN, topics.IMU, topics.ODOMETRY),
        "navigator": (topics.MAP,),
        "mission": (topics.HEAT_STATE, topics.HEAT_SOURCES, topics.HEAT_MARKERS),
    },
}


class RecorderNode(CheckedNode):
    """Finds topics, and gives their messages to the writer."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("recorder_node", **kwargs)
        config = declare_parameters(self, RecorderConfig)
        self.writer = RecordingWriter(bag.file_of(Path(config.folder or _new_folder())))
        self.failure: OSError | None = None  # the recording has ended with it
        self._recorded: dict[str, Subscription] = {}  # by the name of the recorded topic
        # Topics that are not to be recorded, or cannot be.
        self._left_out = {self.resolve_topic_name(name) for name in config.leave_out.split()}
        self._seen: set[str] = set()  # image topics whose `/compressed` one may come yet
        self._needed = NEEDED[config.mission]
        self._listener: KnownListener | None = None  # made when all that is needed is subscribed
        self._ready: set[str] = set()  # peers
        peers = {name: partial(self._is_connected, name) for name in self._needed}
        self._diagnostics = NodeDiagnostics(self, peers)
        wall = Clock(clock_type=ClockType.STEADY_TIME)
        self._clocked = [
            self.create_timer(SEARCH_PERIOD, self.search, clock=wall),
            self.create_timer(FLUSH_PERIOD, self._flush, clock=wall),
        ]
        self.get_logger().info(f"recording into {self.writer.path.parent}")
        self.search()

    def destroy_node(self) -> None:
        """End the file, then the node."""
        if hasattr(self, "writer") and self.failure is None:
            self._try(self.writer.close)
            self.get_logger().info(
                f"recorded {sum(self.writer.counts.values())} messages of "
                f"{len(self._recorded)} topics"
            )
        super().destroy_node()

    def search(self) -> None:
        """Subscribe the topics that are new."""
        found = dict(self.get_topic_names_and_types())
        for name, (kind, *others) in found.items():
            hidden = any(part.startswith("_") for part in name.split("/"))
            recorded = f"{name}/compressed" if kind == IMAGE else name
            if hidden or others or recorded in self._recorded or name in self._left_out:
                continue
            if kind == IMAGE and (recorded in found or name not in self._seen):
                self._seen.add(name)
                continue
            try:
                self._subscribe(name, kind, recorded)
            except RecordingError as error:
                self._left_out.add(name)
                self.get_logger().warning(f"{name} is not recorded: {error}")
        if self._listener is None and all(map(self._records, self._needed.values())):
            self._listener = KnownListener(self)

    def _subscribe(self, name: str, kind: str, recorded: str) -> None:
        publishers = self.get_publishers_info_by_topic(name)
        if not publishers or self.failure is not None:
            return
        offered = [publisher.qos_profile for publisher in publishers]
        recorded_kind = COMPRESSED if kind == IMAGE else kind
        topic = Topic(
            name=recorded,
            type=recorded_kind,
            definition=definition(recorded_kind),
            qos=tuple(qos_words(profile) for profile in offered),
            type_hash="" if kind == IMAGE else str(publishers[0].topic_type_hash),
        )
        self.writer.add_topic(topic)
        callback: Callable[..., None] = self._on_message
        if kind == IMAGE:
            callback = self._on_picture
        elif begins_with_stamp(topic.definition):
            callback = self._on_stamped
        self._recorded[recorded] = self.create_subscription(
            type_of(kind), name, partial(callback, recorded), subscription_profile(offered),
            raw=kind != IMAGE,
        )  # fmt: skip

    def _on_message(self, topic: str, data: bytes) -> None:
        now = time.time_ns()
        self._try(partial(self.writer.write, topic, now, now, data))

    def _on_stamped(self, topic: str, data: bytes) -> None:
        self._try(partial(self.writer.write, topic, time.time_ns(), stamp_in(data), data))

    def _on_picture(self, topic: str, message: Image) -> None:
        now, stamp = time.time_ns(), stamp_of(message.header.stamp)
        data = serialize_message(compressed_of(message))
        self._try(partial(self.writer.write, topic, now, stamp, data))

    def _flush(self) -> None:
        self._diagnostics.counts["messages"] = sum(self.writer.counts.values())
        self._diagnostics.counts["topics"] = len(self._recorded)
        self._try(self.writer.flush)

    def _try(self, step: Callable[[], None]) -> None:
        """Write; a disk that is full ends the recording, and nothing else."""
        if self.failure is not None:
            return
        try:
            step()
        except OSError as error:
            self.failure = error
            self.writer.abandon()

    def _is_connected(self, peer: str) -> bool:
        """Whether all topics that are needed of it are recorded from their next message on."""
        needed = self._needed[peer]
        if not self._records(needed):
            return False
        if peer not in self._ready and self._listener is not None:
            names = [self._recorded[self.resolve_topic_name(topic)].topic_name for topic in needed]
            if all(map(self._listener.known_by_publishers, names)):
                self._ready.add(peer)
        return peer in self._ready

    def _records(self, needed: tuple[str, ...]) -> bool:
        """Whether all these topics are subscribed and published."""
        found = [self._recorded.get(self.resolve_topic_name(topic)) for topic in needed]
        return all(s is not None and s.get_publisher_count() > 0 for s in found)


def _new_folder() -> Path:
    root = Path(os.environ.get("ROVER_RESULTS", "results"))
    return root / f"recording-{datetime.now():%Y%m%d-%H%M%S}-{os.getpid()}"


def record(args: list[str] | None = None) -> None:
    """Record until SIGINT or SIGTERM. Raises RecordingError, or OSError when the disk is full."""
    stop = StopSignals()
    give_way()
    use_patient_profiles()
    # rclpy's own handlers would end the subscriptions before what was published has arrived.
    with start_errors():
        start_ros(args, signal_handler_options=SignalHandlerOptions.NO)
    node = None
    try:
        node = RecorderNode()
        executor = EventsExecutor()
        executor.add_node(node)
        while not stop.asked and node.failure is None:
            stop.spin(executor)
        spin_for(executor, 0.0)  # takes a signal that came between two waits
        spin_for(executor, LAST_SECONDS)
    finally:
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()
    if node.failure is not None:
        raise node.failure


def main() -> None:
    """Entry point of `ros2 run rover_recorder recorder_node`."""
    try:
        record()
    except RoverError as error:
        sys.exit(f"recorder_node: {error}")
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        sys.exit(f"recorder_node: the recording ends: {where}{error.strerror}")
