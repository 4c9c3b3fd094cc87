"""The bridge node: a simulator's telemetry to topics, decisions back to the simulator.

Publishes camera/image_raw, camera/image_raw/compressed (while subscribed), camera/camera_info,
odom, rover_status, bridge_state (latched), /tf, /tf_static (latched), /clock (when the telemetry
carries sim_time) and /diagnostics. Subscribes cmd_drive and /diagnostics. Parameters: BridgeConfig
and InputLimits. Counters: counters.Counter and errors. Answers may carry pictures of node_insets.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rover_interfaces.msg import DriveCommand
from std_msgs.msg import String

from rover_bridge.active_client import ActiveClient
from rover_bridge.answer_sender import AnswerSender
from rover_bridge.codec import decode_telemetry
from rover_bridge.config import BridgeConfig
from rover_bridge.counters import Counter
from rover_bridge.errors import TelemetryError
from rover_bridge.inbox import Inbox
from rover_bridge.node_inputs import BridgeInputs
from rover_bridge.node_insets import InsetDrawer
from rover_bridge.node_publishers import TelemetryPublishers
from rover_bridge.node_runs import KeptRuns
from rover_bridge.pending_requests import Answer, PendingRequest, PendingRequests
from rover_bridge.server import SocketServer
from rover_bridge.telemetry_clock import TelemetryClock
from rover_bridge.transport import (
    Connected,
    ConnectionRefused,
    Disconnected,
    ProtocolErrorReported,
    ServerEvent,
    TelemetryReceived,
    Transport,
)
from rover_bridge.trouble_log import TroubleLog
from rover_common import nodes, topics
from rover_common.ground_truth import load_truth
from rover_common.ros import qos
from rover_common.ros.conversions import command_of
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.types import SAFE_COMMAND

# From a telemetry to its brake at most the deadline and a check of it pass. With a frame of the
# simulator before and one after, that is less than 0.5 s of 10 frames a second.
CHECKS_PER_DEADLINE = 10
EVENTS_PER_TURN = 4  # taken from the inbox before commands and deadlines have their turn


class BridgeNode(Node):
    """Turns server events into topics, and commands into answers, in the executor's thread."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("bridge_node", **kwargs)
        try:
            self._start(declare_parameters(self, BridgeConfig))
        except BaseException:
            self.destroy_node()  # before the context ends, which it must not outlive
            raise

    def _start(self, config: BridgeConfig) -> None:
        truth = load_truth(Path(config.truth)) if config.truth else None
        self._insets = InsetDrawer(self, config, truth)
        self._active = ActiveClient()
        self._requests = PendingRequests(config.answer_deadline)
        self._runs = KeptRuns(self, config.state_dir)
        simulated = bool(self.get_parameter("use_sim_time").value)
        self._telemetry_clock = TelemetryClock(time.time(), time.monotonic(), simulated)
        self._log = TroubleLog()
        self._inbox = Inbox()
        self._arrival = self.create_guard_condition(self._on_arrivals)
        self._server: Transport = SocketServer(
            config.host, config.port, self._on_server_event, config.limits(), config.access()
        )
        self.port = self._server.port
        self._make_endpoints()
        # Wall time: a deadline that waited for simulated time would never come.
        self._deadline_timer = self.create_timer(
            config.answer_deadline / CHECKS_PER_DEADLINE,
            self._check_deadlines,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )
        self.get_logger().info(f"listening on {config.host}:{self.port}")
        self._publish_state()

    def destroy_node(self) -> None:
        """Close the connections, end the server's and the insets' threads, then the node."""
        for part in ("_server", "_insets", "_runs"):
            if hasattr(self, part):
                getattr(self, part).close()
        super().destroy_node()

    def _make_endpoints(self) -> None:
        self._topics = TelemetryPublishers(self, int(self.get_clock().now().nanoseconds))
        self._state = self.create_publisher(String, topics.BRIDGE_STATE, qos.LATCHED)
        command = self.create_subscription(
            DriveCommand, topics.COMMAND, self._on_command, qos.FRAME
        )
        self._inputs = BridgeInputs(self, command)
        self._diagnostics = NodeDiagnostics(
            self, self._topics.peers(command), self._inputs.monitor, self._judge
        )
        self._answers = AnswerSender(self._server, self._insets.take, self._diagnostics.counts)
        self._diagnostics.join(nodes.ROVER, self._inputs.limits.input_error_age)

    def _on_server_event(self, event: ServerEvent) -> None:
        """Called in the server's thread."""
        self._inbox.put(event)
        self._arrival.trigger()

    def _on_arrivals(self) -> None:
        for _ in range(EVENTS_PER_TURN):
            event = self._inbox.take()
            if event is None:
                return
            self._on_event(event)
        self._arrival.trigger()

    def _on_event(self, event: ServerEvent) -> None:
        if isinstance(event, TelemetryReceived):
            try:
                self._on_telemetry(event)
            except Exception as error:  # a defect of this node: also this one has its answer
                self._refuse(event.client, Counter.FAILED, f"telemetry failed: {error!r:.200}")
        elif isinstance(event, Connected):
            self._active.connect(event.client, event.address, time.monotonic())
            self._diagnostics.counts[Counter.CONNECTIONS] += 1
        elif isinstance(event, ProtocolErrorReported):
            self._count(Counter.PROTOCOL_ERRORS, f"protocol error: {event.text}")
        elif isinstance(event, ConnectionRefused):
            self._count(Counter.CONNECTIONS_REFUSED, f"{event.address} refused: {event.reason}")
        elif isinstance(event, Disconnected):
            self._on_disconnected(event.client)

    def _on_disconnected(self, client: str) -> None:
        self._answers.forget(client)
        if self._active.disconnect(client):
            self.get_logger().info(f"client {client} disconnected")
            self._diagnostics.set_warning("simulator", "the simulator has left")
            self._insets.leave()
            self._requests.clear()
            self._publish_state()

    def _on_telemetry(self, event: TelemetryReceived) -> None:
        self._answers.read(event.client, event.wire)
        client, now = event.client, time.monotonic()
        if not self._active.accepts(client, now, owes=self._requests.empty):
            self._refuse(client, Counter.SECOND_CLIENT, "another client is active: braking")
            return
        if self._requests.full:
            self._refuse(client, Counter.OVERLOADED, "too many requests are pending: braking")
            return
        try:
            telemetry = decode_telemetry(event.wire)
            anew = client != self._active.name
            clock_time = self._telemetry_clock.read(telemetry.sim_time, now, anew)
        except TelemetryError as error:
            self._inputs.drop_telemetry(now, str(error))
            self._refuse(client, error.counter, f"telemetry dropped: {error}")
            return
        if anew:
            self._activate(client, now)
        tracked = self._runs.track(telemetry, clock_time)
        if tracked is None:
            self._inputs.drop_telemetry(now, self._runs.contradiction)
            self._refuse(client, Counter.UNCONFIRMED, f"left out: {self._runs.contradiction}")
            return
        self._inputs.note_telemetry(now)
        self._diagnostics.counts[Counter.TELEMETRIES] += 1
        run, stamp = tracked
        if run.start == stamp:
            self._diagnostics.counts[Counter.RUNS] = run.number
            self.get_logger().info(f"run {run.number} begins: {self._runs.reason}")
        self._topics.publish(stamp, run, telemetry)
        self._insets.follow(client, event.wire, run, telemetry.pose)
        # At last: what fails before has another answer.
        self._requests.add(PendingRequest.of(client, stamp, time.monotonic(), telemetry))

    def _activate(self, client: str, now: float) -> None:
        """Another client is the active one from now on."""
        before = self._active.name
        if before is not None:
            silence = self._active.silence(now)
            self._requests.clear()
            text = f"client {client} takes over from {before}, which was silent for {silence:.1f} s"
            self._count(Counter.TAKEOVERS, text)
        self._active.activate(client, now)
        self._diagnostics.set_warning("simulator", "")
        self.get_logger().info(f"client {client} is active")
        self._publish_state()

    def _on_command(self, message: DriveCommand) -> None:
        stamp, command = command_of(message)
        if command.new_run:
            self._runs.request(message.run)
        answer = self._requests.answer(stamp, command)
        if answer is None:
            self._diagnostics.counts[Counter.COMMANDS_LATE] += 1
            return
        now = time.monotonic()
        self._inputs.note_command(now)
        missed = self._log.ends(Counter.DEADLINE_MISSED, now)
        if missed is not None:
            self.get_logger().info(f"decisions come in time again, after {missed:.1f} s")
        if answer.counter == Counter.PICKUP_REFUSED:
            self._warn(answer.counter, "pickup refused: no sample in reach, or not standing still")
        self._answers.send(answer)

    def _check_deadlines(self) -> None:
        now = time.monotonic()
        for answer in self._requests.expire(now):
            self._inputs.drop_command(now)
            self._warn(answer.counter, "no decision in time: braking")
            self._answers.send(answer)

    def _judge(self, now: float) -> None:
        """What is expected, before the inputs are judged."""
        self._inputs.expect(now, self._active.name is not None, owes=self._requests.empty)

    def _refuse(self, client: str, counter: str, text: str) -> None:
        """Answer a telemetry that is not published with the safe brake, and tell why."""
        self._warn(counter, text)
        self._answers.send(Answer(client, SAFE_COMMAND, counter), refused=text)

    def _publish_state(self) -> None:
        self._state.publish(String(data="connected" if self._active.name else "disconnected"))

    def _count(self, counter: str, text: str) -> None:
        self._diagnostics.counts[counter] += 1
        self._warn(counter, text)

    def _warn(self, counter: str, text: str) -> None:
        """Log a line as the trouble of this counter begins."""
        if self._log.begins(counter, time.monotonic()):
            self.get_logger().warning(text)


def main() -> None:
    """Entry point of `ros2 run rover_bridge bridge_node`."""
    run_node(BridgeNode, executor_class=SingleThreadedExecutor)  # it has a guard condition
