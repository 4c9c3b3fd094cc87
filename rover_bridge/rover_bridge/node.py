"""The bridge node: a simulator's telemetry to topics, decisions back to the simulator.

Publishes camera/image_raw, camera/image_raw/compressed (while subscribed), camera/camera_info,
odom, rover_status, bridge_state (latched), /tf, /tf_static (latched), /clock (when the telemetry
carries sim_time) and /diagnostics. Subscribes cmd_drive. Parameters: BridgeConfig. Counters:
counters.Counter and errors. Answers may carry pictures, which node_insets draws.
"""

from __future__ import annotations

import sys
import time
from collections import deque
from pathlib import Path
from typing import Any

from nav_msgs.msg import Odometry
from rclpy.clock import Clock, ClockType
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rosgraph_msgs.msg import Clock as ClockMsg
from rover_interfaces.msg import DriveCommand, RoverStatus
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from rover_bridge import conversions
from rover_bridge.codec import decode_telemetry, encode_drive, uses_decimal_comma
from rover_bridge.config import BridgeConfig
from rover_bridge.counters import Counter
from rover_bridge.errors import TelemetryError
from rover_bridge.node_insets import InsetDrawer
from rover_bridge.pending_requests import Answer, PendingRequest, PendingRequests
from rover_bridge.run_tracker import RunTracker
from rover_bridge.server import (
    Connected,
    ProtocolErrorReported,
    ServerEvent,
    SocketServer,
    TelemetryReceived,
)
from rover_common import frames, topics
from rover_common.errors import RoverError
from rover_common.ground_truth import load_truth
from rover_common.ros import qos
from rover_common.ros.conversions import (
    NANOSECONDS,
    command_of,
    image_message_of,
    jpeg_message_of,
    odometry_of,
)
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.types import SAFE_COMMAND, Run, Telemetry

LOG_PERIOD = 5.0  # [s] between two lines about the same counter
CHECKS_PER_DEADLINE = 4


class BridgeNode(Node):
    """Turns server events into topics, and commands into answers, in the executor's thread."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("bridge_node", **kwargs)
        config = declare_parameters(self, BridgeConfig)
        truth = load_truth(Path(config.truth)) if config.truth else None
        self._insets = InsetDrawer(self, config, truth)
        self._requests = PendingRequests(config.answer_deadline)
        self._runs = RunTracker()
        self._comma_clients: set[str] = set()
        self._warned: dict[str, float] = {}  # [s] wall time of the last line per counter
        self._make_endpoints()
        self._inbox: deque[ServerEvent] = deque()
        self._arrival = self.create_guard_condition(self._on_arrivals)
        # Wall time: a deadline that waited for simulated time would never come.
        self._deadline_timer = self.create_timer(
            config.answer_deadline / CHECKS_PER_DEADLINE,
            self._check_deadlines,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )
        self._server = SocketServer(config.host, config.port, self._on_server_event)
        self.port = self._server.port
        self.get_logger().info(f"listening on {config.host}:{self.port}")
        self._publish_state()

    def destroy_node(self) -> None:
        """Close the connections, end the server's and the insets' threads, then the node."""
        if hasattr(self, "_server"):
            self._server.close()
        if hasattr(self, "_insets"):
            self._insets.close()
        super().destroy_node()

    def _make_endpoints(self) -> None:
        publish = self.create_publisher
        self._image = publish(Image, topics.IMAGE, qos.FRAME)
        self._compressed = publish(CompressedImage, topics.COMPRESSED_IMAGE, qos.FRAME)
        self._odometry = publish(Odometry, topics.ODOMETRY, qos.FRAME)
        self._status = publish(RoverStatus, topics.STATUS, qos.FRAME)
        self._camera_info = publish(CameraInfo, topics.CAMERA_INFO, qos.FRAME)
        self._state = publish(String, topics.BRIDGE_STATE, qos.LATCHED)
        self._clock_publisher = publish(ClockMsg, "/clock", qos.CLOCK)
        self._tf = publish(TFMessage, "/tf", qos.TF)
        self._tf_static = publish(TFMessage, "/tf_static", qos.TF_STATIC)
        self._tf_static.publish(conversions.static_transforms_of(self._now()))
        command = self.create_subscription(
            DriveCommand, topics.COMMAND, self._on_command, qos.FRAME
        )
        peers = {
            "perception": lambda: self._image.get_subscription_count() > 0,
            "odometry": lambda: self._odometry.get_subscription_count() > 1,
            "decision": lambda: (
                command.get_publisher_count() > 0 and self._status.get_subscription_count() > 0
            ),
        }
        self._diagnostics = NodeDiagnostics(self, peers)

    def _on_server_event(self, event: ServerEvent) -> None:
        """Called in the server's thread."""
        self._inbox.append(event)
        self._arrival.trigger()

    def _on_arrivals(self) -> None:
        while self._inbox:
            event = self._inbox.popleft()
            if isinstance(event, TelemetryReceived):
                self._on_telemetry(event)
            elif isinstance(event, Connected):
                self._diagnostics.counts[Counter.CONNECTIONS] += 1
                self.get_logger().info(f"client {event.client} connected")
            elif isinstance(event, ProtocolErrorReported):
                self._diagnostics.counts[Counter.PROTOCOL_ERRORS] += 1
                self._warn(Counter.PROTOCOL_ERRORS, f"protocol error: {event.text}")
            else:
                self.get_logger().info(f"client {event.client} disconnected")
                if event.client == self._requests.active_client:
                    self._insets.leave()
                self._requests.remove_client(event.client)
                self._comma_clients.discard(event.client)
                self._publish_state()

    def _on_telemetry(self, event: TelemetryReceived) -> None:
        if uses_decimal_comma(event.wire):
            self._comma_clients.add(event.client)
        client, active_before = event.client, self._requests.active_client
        if not self._requests.accept(client, time.monotonic()):
            self._refuse(client, Counter.SECOND_CLIENT, "another client is active: braking")
            return
        if self._requests.active_client != active_before:
            self.get_logger().info(f"client {client} is active")
            self._publish_state()
        if self._requests.full:
            self._refuse(client, Counter.OVERLOADED, "too many requests are pending: braking")
            return
        try:
            telemetry = decode_telemetry(event.wire)
        except TelemetryError as error:
            self._refuse(client, error.counter, f"telemetry dropped: {error}")
            return
        self._diagnostics.counts[Counter.TELEMETRIES] += 1
        run, stamp = self._runs.track(telemetry, self._time_of(telemetry))
        if run.start == stamp:
            self._diagnostics.counts[Counter.RUNS] = run.number
            self.get_logger().info(f"run {run.number} begins")
        self._requests.add(
            PendingRequest(
                client=client,
                stamp=stamp,
                arrived=time.monotonic(),
                speed=telemetry.speed,
                near_sample=telemetry.near_sample,
                picking_up=telemetry.picking_up,
            )
        )
        self._publish(stamp, run, telemetry)
        self._insets.follow(client, event.wire, run, telemetry.pose)

    def _publish(self, stamp: int, run: Run, telemetry: Telemetry) -> None:
        """What the other nodes wait for comes first."""
        image = image_message_of(stamp, frames.CAMERA_OPTICAL, telemetry.image)
        self._odometry.publish(odometry_of(stamp, telemetry.pose, telemetry.speed))
        self._image.publish(image)
        self._status.publish(conversions.status_of(stamp, run, telemetry))
        if telemetry.sim_time is not None:
            self._clock_publisher.publish(conversions.clock_of(stamp))
        self._tf.publish(conversions.body_transform_of(stamp, telemetry.pose))
        self._camera_info.publish(conversions.camera_info_of(stamp))
        if self._compressed.get_subscription_count() > 0:
            self._compressed.publish(jpeg_message_of(image.header, telemetry.jpeg))

    def _on_command(self, message: DriveCommand) -> None:
        stamp, command = command_of(message)
        if command.new_run:
            self._runs.request(message.run)
        answer = self._requests.answer(stamp, command)
        if answer is None:
            self._diagnostics.counts[Counter.COMMANDS_LATE] += 1
            return
        if answer.counter == Counter.PICKUP_REFUSED:
            self._warn(answer.counter, "pickup refused: no sample in reach, or not standing still")
        self._send(answer)

    def _check_deadlines(self) -> None:
        for answer in self._requests.expire(time.monotonic()):
            self._warn(answer.counter, "no decision in time: braking")
            self._send(answer)

    def _refuse(self, client: str, counter: str, text: str) -> None:
        """Answer a telemetry that is not published with the safe brake."""
        self._warn(counter, text)
        self._send(Answer(client, SAFE_COMMAND, counter))

    def _send(self, answer: Answer) -> None:
        self._diagnostics.counts[answer.counter] += 1
        if answer.command.pickup:
            self._server.send(answer.client, "pickup", {})
        else:
            comma, insets = answer.client in self._comma_clients, self._insets.take(answer.client)
            self._server.send(answer.client, "data", encode_drive(answer.command, comma, insets))

    def _publish_state(self) -> None:
        active = self._requests.active_client
        self._state.publish(String(data="disconnected" if active is None else "connected"))

    def _time_of(self, telemetry: Telemetry) -> float:
        """[s] of the simulator's clock, of the node's where the telemetry has no sim_time."""
        return self._now() / NANOSECONDS if telemetry.sim_time is None else telemetry.sim_time

    def _now(self) -> int:
        return int(self.get_clock().now().nanoseconds)

    def _warn(self, counter: str, text: str) -> None:
        """Log a line, unless one about this counter was logged within LOG_PERIOD."""
        now = time.monotonic()
        if now - self._warned.get(counter, -LOG_PERIOD) >= LOG_PERIOD:
            self._warned[counter] = now
            self.get_logger().warning(text)


def main() -> None:
    """Entry point of `ros2 run rover_bridge bridge_node`."""
    try:
        run_node(BridgeNode, executor_class=SingleThreadedExecutor)  # it has a guard condition
    except (OSError, RoverError) as error:  # such as a port in use, or no file of the truth
        sys.exit(f"bridge_node: {error}")
