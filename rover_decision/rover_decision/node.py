"""The decision node: perception results to drive commands, one for every frame.

Subscribes odom, rover_status, nav_polar, rock_polar, free_scan and rocks (joined by stamp),
navigation_map and /diagnostics.
Publishes cmd_drive, mission_state (latched), plan and mission_markers (both while subscribed) and
/diagnostics. Services ~/start, ~/pause, ~/resume, ~/return_home, ~/reset (std_srvs/Trigger); action
~/run_mission (rover_interfaces/RunMission). Parameters: see DecisionConfig and InputLimits. In
simulated time a frame waits for the plan that counts from it on, so that a mission repeats exactly.
"""

from __future__ import annotations

import time
from collections import deque
from functools import partial
from typing import Any

from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.clock import Clock, ClockType
from rover_interfaces.msg import (
    DriveCommand,
    MissionState,
    PolarArray,
    RockTrackArray,
    RoverStatus,
)
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger
from visualization_msgs.msg import MarkerArray

from rover_common import nodes, topics
from rover_common.errors import RoverError
from rover_common.frames import FrameConfig, Frames
from rover_common.ros import conversions, qos, scan_conversions
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.ros.state import NodeState
from rover_common.ros.sync import ExactTimeSynchronizer
from rover_common.saved_state import SavedState
from rover_common.state_keeper import MakeState
from rover_decision.conversions import markers_of, mission_state_of, path_message_of
from rover_decision.missions.sample_return import configure, make_core, memory_of, resume
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.node_action import RunMissionServer
from rover_decision.node_inputs import FRAMES, DecisionInputs
from rover_decision.types import Decision, Frame, Request

FRAME_PARTS = {
    topics.ODOMETRY: Odometry,
    topics.STATUS: RoverStatus,
    topics.NAV_POLAR: PolarArray,
    topics.ROCK_POLAR: PolarArray,
    topics.FREE_SCAN: LaserScan,
    topics.ROCKS: RockTrackArray,
}
Parts = dict[str, Any]  # of one frame, by topic
VERSION = 1  # of what is saved
REPORT_PERIOD = 500_000_000  # [ns] of frame time
PATIENCE = 5.0  # [s] of wall time that a frame waits for the map of its plan


class DecisionNode(CheckedNode):
    """Collects one frame's parts, steps the core, publishes what it decided."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("decision_node", **kwargs)
        self._frames = declare_parameters(self, FrameConfig).frames()
        config = declare_parameters(self, DecisionConfig, self._on_config)
        lockstep = bool(self.get_parameter("use_sim_time").value)
        self._config = config
        self._core = make_core(config, lockstep)
        self._state_file = NodeState(self, config.state_dir, "sample return", VERSION)
        self._newest: Frame | None = None  # decided on
        self._saved_progress: Any = None  # of the newest frame
        self._sync = ExactTimeSynchronizer(tuple(FRAME_PARTS))
        self._waiting: deque[tuple[float, Frame]] = deque()  # [s] of wall time since when
        self._reported: tuple[int, Any] | None = None  # [ns] and state of the last report
        self._command = self.create_publisher(DriveCommand, topics.COMMAND, qos.FRAME)
        self._state = self.create_publisher(MissionState, topics.MISSION_STATE, qos.LATCHED)
        self._plan = self.create_publisher(Path, topics.PLAN, qos.VIEW)
        self._markers = self.create_publisher(MarkerArray, topics.MISSION_MARKERS, qos.VIEW)
        self.expect_frames(_frame_ids_of(self._frames))
        heard = {
            topic: self.create_subscription(kind, topic, partial(self._on_part, topic), qos.FRAME)
            for topic, kind in FRAME_PARTS.items()
        }
        parts = tuple(heard.values())
        heard[topics.NAVIGATION_MAP] = self.create_subscription(
            OccupancyGrid, topics.NAVIGATION_MAP, self._on_map, qos.LATCHED
        )
        for request in Request:
            self.create_service(Trigger, f"~/{request.value}", partial(self._on_request, request))
        self._action = RunMissionServer(self, self._core)
        self._wait_timer = self.create_timer(
            PATIENCE / 5, self._on_wait, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        peers = {
            "bridge": lambda: self._command.get_subscription_count() > 0,
            "frames": lambda: all(part.get_publisher_count() > 0 for part in parts),
        }
        self._inputs = DecisionInputs(self, heard)
        self._diagnostics = NodeDiagnostics(self, peers, self._inputs.monitor)
        self._diagnostics.join(nodes.ROVER, self._inputs.limits.input_error_age)

    def destroy_node(self) -> None:
        """End the action's goal and the planner's thread, then the node."""
        if hasattr(self, "_action"):
            self._action.destroy()
        if hasattr(self, "_core"):
            self._core.close()
        if hasattr(self, "_state_file"):
            self._state_file.close(self._snapshot if self._newest is not None else None)
        super().destroy_node()

    def _on_config(self, config: DecisionConfig) -> None:
        self._config = config
        try:
            configure(self._core, config)
        except RoverError as error:  # of an explorer that cannot be imported
            self.get_logger().error(f"the mission goes on as before: {error}")
        else:
            self.get_logger().info(f"parameters: {config}")

    def _on_request(
        self, request: Request, _: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        response.success = self._core.request(request)
        response.message = f"{request.value}: {self._core.state.name}"
        self.get_logger().info(response.message)
        self._action.settle()
        return response

    def _on_map(self, message: OccupancyGrid) -> None:
        self._inputs.note(topics.NAVIGATION_MAP)
        stamp = conversions.stamp_of(message.header.stamp)
        self._core.give_map(stamp, conversions.grid_of(message))
        self._work()

    def _on_part(self, topic: str, message: Any) -> None:
        self._inputs.note(topic)
        parts = self._sync.add(topic, conversions.stamp_of(message.header.stamp), message)
        self._diagnostics.counts["frames_incomplete"] = self._sync.dropped
        self._inputs.note_incomplete(self._sync.dropped)
        if parts is not None:
            self._waiting.append((time.monotonic(), _frame_of(parts)))
            self._work()

    def _work(self) -> None:
        """Decide on the frames that have all they need, in their order."""
        while self._waiting and self._core.ready(self._waiting[0][1].stamp):
            self._on_frame(self._waiting.popleft()[1])

    def _on_wait(self) -> None:
        """A map that does not come must not hold up the frames for ever."""
        if self._waiting and time.monotonic() - self._waiting[0][0] > PATIENCE:
            self._core.stop_waiting()
            self._work()

    def _on_frame(self, frame: Frame) -> None:
        failures = self._core.plan_failures
        self._state_file.resume(frame.run, frame.stamp, self._resume)
        with self._diagnostics.ticks:
            decision = self._core.step(frame)
        self._diagnostics.state = decision.state.name
        now = int(self.get_clock().now().nanoseconds)
        self._command.publish(
            conversions.command_message_of(
                now, frame.stamp, frame.run, decision.command, self._frames
            )
        )
        self._inputs.note(FRAMES)
        self._diagnostics.counts["frames"] += 1
        self._diagnostics.counts["plans_failed"] = self._core.plan_failures
        if self._core.plan_failures > failures:
            self.get_logger().error(
                f"planner: {self._core.last_failure}", throttle_duration_sec=PATIENCE
            )
        self._report(frame, decision)
        self._keep(frame, decision)

    def _resume(self, saved: SavedState) -> None:
        resume(self._core, self._config, saved.run, (saved.values, saved.arrays))

    def _keep(self, frame: Frame, decision: Decision) -> None:
        """Save the state now and then; the start and each sample at once."""
        if self._core.mission.idle:  # it waits for a new run
            self._newest = None
            return
        self._newest = frame
        progress = frame.run, decision.progress.samples_collected
        self._state_file.keep(self._snapshot, at_once=progress != self._saved_progress)
        self._saved_progress = progress

    def _snapshot(self) -> MakeState:
        assert self._newest is not None
        state = SavedState(self._newest.run, self._newest.stamp, *memory_of(self._core))
        return lambda: state

    def _report(self, frame: Frame, decision: Decision) -> None:
        """On every change of state, and twice a second."""
        changed = self._reported is None or self._reported[1] is not decision.state
        if changed:
            self.get_logger().info(f"{decision.state.name}: {decision.reason}")
        elif self._reported is not None and abs(frame.stamp - self._reported[0]) < REPORT_PERIOD:
            return
        self._reported = (frame.stamp, decision.state)
        report = mission_state_of(frame.stamp, frame.run, decision, self._frames)
        self._state.publish(report)
        self._action.on_report(report)
        self._show(frame)

    def _show(self, frame: Frame) -> None:
        """Plan and markers, while subscribed."""
        overlay = self._core.mission.overlay()
        if self._plan.get_subscription_count() > 0 and overlay.path is not None:
            self._plan.publish(path_message_of(frame.stamp, overlay.path, self._frames))
        if self._markers.get_subscription_count() > 0:
            markers = markers_of(frame.stamp, frame.rocks, overlay, self._frames)
            self._markers.publish(markers)


def _frame_ids_of(frames: Frames) -> dict[str, str]:
    """What the headers of a topic's messages have to name."""
    return {
        topics.ODOMETRY: frames.odom,
        topics.NAV_POLAR: frames.base,
        topics.ROCK_POLAR: frames.base,
        topics.FREE_SCAN: frames.base,
        topics.ROCKS: frames.map,
        topics.NAVIGATION_MAP: frames.map,
    }


def _frame_of(parts: Parts) -> Frame:
    rocks = parts[topics.ROCKS]
    return Frame(
        vehicle=conversions.vehicle_state_of(parts[topics.ODOMETRY], parts[topics.STATUS]),
        nav=scan_conversions.polar_of(parts[topics.NAV_POLAR]),
        scan=scan_conversions.scan_of(parts[topics.FREE_SCAN]),
        rocks=conversions.rocks_of(rocks),
        map_stamp=conversions.stamp_of(rocks.map_stamp),
        rock=scan_conversions.polar_of(parts[topics.ROCK_POLAR]),
    )


def main() -> None:
    """Entry point of `ros2 run rover_decision decision_node`."""
    run_node(DecisionNode, keeps_maps=True)
