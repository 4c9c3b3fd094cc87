"""A node in the bridge's place: publishes recorded frames, and takes the commands on them.

Publishes camera/image_raw, odom, rover_status and /clock. Subscribes cmd_drive and worldmap.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

from nav_msgs.msg import OccupancyGrid, Odometry
from rosgraph_msgs.msg import Clock
from rover_interfaces.msg import DriveCommand, RoverStatus
from sensor_msgs.msg import Image

from rover_bridge.codec import decode_jpeg
from rover_common import topics
from rover_common.frames import CAMERA_OPTICAL
from rover_common.ros import conversions, qos
from rover_common.types import Command, GridMap
from rover_simulator.recordings.replay import ANSWER_TIMEOUT, NoAnswerError, Playback
from rover_tools.runner.node_diagnostics import GraphNotReadyError
from rover_tools.runner.node_in_domain import NodeInDomain
from rover_tools.runner.recorded_run import FrameMessages

READY_SECONDS = 10.0  # [s] for the nodes to know the player, and the player the nodes
MAP_SECONDS = 5.0  # [s] for the map of a frame to arrive
SPIN_SECONDS = 0.05  # [s]


class Player(NodeInDomain):
    """Plays into the perception and decision nodes of a domain, in the caller's thread."""

    def __init__(self, domain_id: int) -> None:
        super().__init__("player", domain_id)
        self.commands: dict[int, Command] = {}  # by the stamp [ns] of the frame
        self.map_then: GridMap | None = None  # after the frame of `map_stamp`
        self._sent: dict[int, float] = {}  # [s] when, of the frames without an answer, by stamp
        self._latencies: list[float] = []
        self._map: tuple[int, GridMap] | None = None  # the newest, with its stamp
        publish, subscribe = self.node.create_publisher, self.node.create_subscription
        self._image = publish(Image, topics.IMAGE, qos.FRAME)
        self._odometry = publish(Odometry, topics.ODOMETRY, qos.FRAME)
        self._status = publish(RoverStatus, topics.STATUS, qos.FRAME)
        self._clock = publish(Clock, "/clock", qos.CLOCK)
        self._command = subscribe(DriveCommand, topics.COMMAND, self._on_command, qos.FRAME)
        subscribe(OccupancyGrid, topics.WORLDMAP, self._on_map, qos.LATCHED)

    def play(
        self,
        frames: Iterable[FrameMessages],
        in_flight: int,
        map_stamp: int | None,
        on_answer: Callable[[], None] = lambda: None,
    ) -> Playback:
        """Publish every frame as fast as the commands come, and keep what they were.

        At most `in_flight` frames are without a command at any time. `map_stamp` [ns]: of the frame
        after which the map is kept. Raises GraphNotReadyError, NoAnswerError, or TelemetryError for
        an image that is none.
        """
        if not self._spin_until(self._connected, READY_SECONDS):
            raise GraphNotReadyError(f"the nodes did not find the player in {READY_SECONDS:g} s")
        start = time.perf_counter()
        stamp = 0
        for frame in frames:
            stamp = frame.stamp
            self._publish(frame)
            self._take_answers(in_flight - 1, on_answer)
            if stamp == map_stamp:
                self._take_answers(0, on_answer)
                self.map_then = self._wait_map(stamp)
        self._take_answers(0, on_answer)
        return Playback(
            frames=len(self._latencies),
            skipped=0,
            latencies=tuple(self._latencies),
            seconds=time.perf_counter() - start,
            last_time=stamp / conversions.NANOSECONDS,
        )

    def _publish(self, frame: FrameMessages) -> None:
        image = conversions.image_message_of(frame.stamp, CAMERA_OPTICAL, decode_jpeg(frame.jpeg))
        self._sent[frame.stamp] = time.perf_counter()
        self._odometry.publish(frame.odometry)
        self._image.publish(image)
        self._status.publish(frame.status)
        self._clock.publish(Clock(clock=conversions.time_of(frame.stamp)))

    def _take_answers(self, left: int, on_answer: Callable[[], None]) -> None:
        """Wait until at most `left` frames are without a command."""
        while len(self._sent) > left:
            before = len(self._sent)
            if not self._spin_until(lambda: len(self._sent) < before, ANSWER_TIMEOUT):  # noqa: B023
                raise NoAnswerError(f"no command within {ANSWER_TIMEOUT:.0f} s")
            on_answer()

    def _wait_map(self, stamp: int) -> GridMap | None:
        if self._spin_until(lambda: self._map is not None and self._map[0] == stamp, MAP_SECONDS):
            assert self._map is not None
            return self._map[1]
        return None

    def _connected(self) -> bool:
        """To perception, and where decision subscribes too, to both."""
        return (
            self._image.get_subscription_count() >= 1
            and self._odometry.get_subscription_count() >= 2
            and self._status.get_subscription_count() >= 2
            and self._command.get_publisher_count() >= 1
        )

    def _spin_until(self, predicate: Callable[[], bool], timeout: float) -> bool:
        end = time.monotonic() + timeout
        while not predicate():
            if time.monotonic() > end:
                return False
            self.executor.spin_once(timeout_sec=SPIN_SECONDS)
        return True

    def _on_command(self, message: DriveCommand) -> None:
        stamp, command = conversions.command_of(message)
        sent = self._sent.pop(stamp, None)
        if sent is not None:
            self._latencies.append(time.perf_counter() - sent)
            self.commands[stamp] = command

    def _on_map(self, message: OccupancyGrid) -> None:
        stamp = conversions.stamp_of(message.header.stamp)
        self._map = stamp, conversions.grid_of(message)
