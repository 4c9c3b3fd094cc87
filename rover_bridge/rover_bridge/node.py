"""The bridge node: a simulator's telemetry to topics, decisions back to the simulator.

Publishes camera/image_raw, camera/image_raw/compressed (while subscribed), camera/camera_info,
odom, rover_status, bridge_state (latched), /tf, /tf_static (latched), /clock (when the telemetry
carries sim_time) and /diagnostics. Subscribes cmd_drive and /diagnostics. A lifecycle node.
Parameters: BridgeConfig, InputLimits, LifecycleConfig, CameraFrameConfig. Counters: see counters.
"""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.executors import SingleThreadedExecutor
from rover_interfaces.msg import DriveCommand
from std_msgs.msg import String

from rover_bridge import transport
from rover_bridge.active_client import ActiveClient
from rover_bridge.answer_sender import AnswerSender
from rover_bridge.codec import decode_telemetry
from rover_bridge.config import BridgeConfig, CameraFrameConfig
from rover_bridge.counters import Counter
from rover_bridge.errors import TelemetryError
from rover_bridge.node_drivers import DriverTopics
from rover_bridge.node_inputs import BridgeInputs
from rover_bridge.node_insets import InsetDrawer
from rover_bridge.node_listener import Listener
from rover_bridge.node_publishers import TelemetryPublishers
from rover_bridge.node_runs import KeptRuns
from rover_bridge.pending_requests import Answer, PendingRequest, PendingRequests
from rover_bridge.telemetry_clock import TelemetryClock
from rover_common import nodes, topics
from rover_common.ros import qos
from rover_common.ros.conversions import command_of, stamp_of
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.lifecycle import ManagedNode
from rover_common.ros.notices import Notices
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.types import SAFE_COMMAND, Command

# From a telemetry to its brake at most the deadline and a check of it pass. With a frame of the
# simulator before and one after, that is less than 0.5 s of 10 frames a second.
CHECKS_PER_DEADLINE = 10


class BridgeNode(ManagedNode):
    """Turns server events into topics, and commands into answers, in the executor's thread."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("bridge_node", **kwargs)
        self.bring_up(self._prepare)

    def _prepare(self) -> None:
        self._frames = declare_parameters(self, CameraFrameConfig).frames()
        self._config = config = declare_parameters(
            self, BridgeConfig, lambda new: self._insets.configure(new)
        )
        self._insets = InsetDrawer(self, config, config.true_map(), self._frames.map)
        self._active = ActiveClient()
        self._requests = PendingRequests(config.answer_deadline)
        self._runs = KeptRuns(self, config.state_dir)
        simulated = bool(self.get_parameter("use_sim_time").value)
        self._telemetry_clock = TelemetryClock(time.time(), time.monotonic(), simulated)
        self._notices = Notices(self)
        self._listener = Listener(self, self._on_event)
        self._make_endpoints(config)
        # Wall time: a deadline that waited for simulated time would never come.
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        period = config.answer_deadline / CHECKS_PER_DEADLINE
        self._deadline_timer = self.create_timer(period, self._check_deadlines, clock=steady)
        self._publish_state()

    def _make_endpoints(self, config: BridgeConfig) -> None:
        self._topics = TelemetryPublishers(self, self._frames, config)
        self._state = self.create_publisher(String, topics.BRIDGE_STATE, qos.LATCHED)
        drive = self.create_subscription(  # what it cannot use brakes, and no later than the rest
            DriveCommand, topics.COMMAND, self._on_command, qos.FRAME,
            refused=lambda message: self._answer(stamp_of(message.frame_stamp), SAFE_COMMAND),
        )  # fmt: skip
        self._inputs = BridgeInputs(self, drive)
        self._diagnostics = NodeDiagnostics(
            self, self._topics.peers(drive), self._inputs.monitor,
            lambda now: self._inputs.expect(
                now, self.active and bool(self._active.name), self._requests.empty
            ),
        )  # fmt: skip
        self._answers = AnswerSender(self._listener, self._insets.take, self._diagnostics.counts)
        self._diagnostics.join(nodes.ROVER, self._inputs.limits.input_error_age)
        self._drivers = DriverTopics(self, self._diagnostics, config.enable_stamped_cmd_vel, drive)

    def configure(self) -> None:
        """Listen; until it is activated, every telemetry is answered with the brake."""
        self._listener.open(self._config)
        self.port = self._listener.port
        self.get_logger().info(f"listening on {self._config.host}:{self.port}")

    def deactivate(self) -> None:
        """Brake: what waits for a decision, and all that comes."""
        for answer in self._requests.expire(math.inf):
            self._answers.send(replace(answer, counter=Counter.INACTIVE))

    def cleanup(self) -> None:
        """Listen no more."""
        self._listener.close()
        if self._active.name is not None:
            self._on_disconnected(self._active.name)
        self._active = ActiveClient()

    def destroy_node(self) -> None:
        """Close the connections, end the server's and the insets' threads, then the node."""
        for part in ("_listener", "_insets", "_runs"):
            if hasattr(self, part):
                getattr(self, part).close()
        super().destroy_node()

    def _on_event(self, event: transport.ServerEvent) -> None:
        if isinstance(event, transport.TelemetryReceived):
            try:
                self._on_telemetry(event)
            except Exception as error:  # a defect of this node: also this one has its answer
                self._refuse(event.client, Counter.FAILED, f"telemetry failed: {error!r:.200}")
        elif isinstance(event, transport.Connected):
            self._active.connect(event.client, event.address, time.monotonic())
            self._diagnostics.counts[Counter.CONNECTIONS] += 1
            self.get_logger().debug(f"client {event.client} of {event.address} connected")
        elif isinstance(event, transport.ProtocolErrorReported):
            self._count(Counter.PROTOCOL_ERRORS, f"protocol error: {event.text}")
        elif isinstance(event, transport.ConnectionRefused):
            self._count(Counter.CONNECTIONS_REFUSED, f"{event.address} refused: {event.reason}")
        elif isinstance(event, transport.Disconnected):
            self._on_disconnected(event.client)

    def _on_disconnected(self, client: str) -> None:
        self._answers.forget(client)
        if self._active.disconnect(client):
            self.get_logger().info(f"client {client} disconnected")
            self._diagnostics.set_warning("simulator", "the simulator has left")
            self._insets.leave()
            self._requests.clear()
            self._publish_state()

    def _on_telemetry(self, event: transport.TelemetryReceived) -> None:
        self._answers.read(event.client, event.wire)
        client, now = event.client, time.monotonic()
        if not self.active:
            self._refuse(client, Counter.INACTIVE, "the bridge is not active: braking")
            return
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
            self._drop(client, now, error.counter, str(error))
            return
        if anew:
            self._activate(client, now)
        tracked = self._runs.track(telemetry, clock_time, self._telemetry_clock.jump_confirmed)
        if tracked is None:
            self._drop(client, now, Counter.UNCONFIRMED, self._runs.contradiction)
            return
        self._inputs.note_telemetry(now)
        self._diagnostics.counts[Counter.TELEMETRIES] += 1
        run, stamp = tracked
        if run.start == stamp:
            self._diagnostics.counts[Counter.RUNS] = run.number
            self.get_logger().info(f"run {run.number} begins: {self._runs.reason}")
        self._topics.publish(stamp, run, telemetry)
        self._insets.follow(client, event.wire, run, telemetry.pose)
        request = PendingRequest.of(client, stamp, time.monotonic(), telemetry)
        command = self._drivers.answer(stamp, telemetry)
        self._requests.add(request)  # at last: what fails before has another answer
        if command is not None:
            self._answer(stamp, command)

    def _activate(self, client: str, now: float) -> None:
        """Another client is the active one from now on."""
        if (before := self._active.name) is not None:
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
        self._drivers.hear_decision()
        if self._answer(stamp, command):
            self._inputs.note_command(time.monotonic())
            self._notices.end(Counter.DEADLINE_MISSED, "decisions come in time again")

    def _answer(self, stamp: int, command: Command) -> bool:
        """The telemetry of this stamp [ns]; False if it has its answer already."""
        answer = self._requests.answer(stamp, command)
        if answer is None:
            self._diagnostics.counts[Counter.COMMANDS_LATE] += 1
            return False
        if answer.counter == Counter.PICKUP_REFUSED:
            self._notices.warn(answer.counter, "pickup refused: no sample in reach, or moving")
        self._answers.send(answer)
        return True

    def _check_deadlines(self) -> None:
        now = time.monotonic()
        for answer in self._requests.expire(now):
            self._inputs.drop_command(now)
            self._notices.warn(answer.counter, "no decision in time: braking")
            self._answers.send(answer)

    def _drop(self, client: str, now: float, counter: str, why: str) -> None:
        self._inputs.drop_telemetry(now, why)
        self._refuse(client, counter, f"telemetry dropped: {why}")

    def _refuse(self, client: str, counter: str, text: str) -> None:
        """Answer a telemetry that is not published with the safe brake, and tell why."""
        self._notices.warn(counter, text)
        self._answers.send(Answer(client, SAFE_COMMAND, counter), refused=text)

    def _publish_state(self) -> None:
        self._diagnostics.state = state = "connected" if self._active.name else "disconnected"
        self._state.publish(String(data=state))

    def _count(self, counter: str, text: str) -> None:
        self._diagnostics.counts[counter] += 1
        self._notices.warn(counter, text)


def main() -> None:
    """Entry point of `ros2 run rover_bridge bridge_node`."""
    run_node(BridgeNode, executor_class=SingleThreadedExecutor)  # it has a guard condition
