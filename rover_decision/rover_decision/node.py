"""The decision node: percepts to drive commands, one for every frame.

Subscribes odom, rover_status, nav_polar, free_scan and rocks (joined by stamp), and navigation_map.
Publishes cmd_drive, mission_state (latched), mission_markers (while subscribed) and /diagnostics.
Services ~/start, ~/pause, ~/resume, ~/return_home, ~/reset (std_srvs/Trigger); action ~/run_mission
(rover_interfaces/RunMission). Parameters: see DecisionConfig. In simulated time a frame waits for
the plan that counts from it on, so that a mission repeats exactly.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import Any

from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
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

from rover_common import topics
from rover_common.ros import conversions, qos
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.ros.sync import ExactTimeSynchronizer
from rover_decision.config import DecisionConfig
from rover_decision.conversions import markers_of, mission_state_of
from rover_decision.mission import Mission
from rover_decision.node_action import RunMissionServer
from rover_decision.states import State
from rover_decision.types import Decision, Snapshot
from rover_navigation.plan_scheduler import PlanDesk
from rover_navigation.planner import Planner

FRAME_PARTS = {
    topics.ODOMETRY: Odometry,
    topics.STATUS: RoverStatus,
    topics.NAV_POLAR: PolarArray,
    topics.FREE_SCAN: LaserScan,
    topics.ROCKS: RockTrackArray,
}
Parts = dict[str, Any]  # of one frame, by topic
REPORT_PERIOD = 500_000_000  # [ns] of frame time


class DecisionNode(Node):
    """Collects one frame's parts into a snapshot, ticks the mission, publishes what it decided."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("decision_node", **kwargs)
        config = declare_parameters(self, DecisionConfig)
        self._mission = Mission(config)
        lockstep = bool(self.get_parameter("use_sim_time").value)
        self._desk = PlanDesk(Planner(config.explorer).plan, config.plan_delay, lockstep)
        self._join = ExactTimeSynchronizer(tuple(FRAME_PARTS))
        self._waiting: deque[tuple[int, Parts]] = deque()  # frames that need a plan first
        self._reported: tuple[int, State] | None = None
        self._command = self.create_publisher(DriveCommand, topics.COMMAND, qos.FRAME)
        self._state = self.create_publisher(MissionState, topics.MISSION_STATE, qos.LATCHED)
        self._markers = self.create_publisher(MarkerArray, topics.MISSION_MARKERS, qos.VIEW)
        parts = [
            self.create_subscription(kind, topic, partial(self._on_part, topic), qos.FRAME)
            for topic, kind in FRAME_PARTS.items()
        ]
        self.create_subscription(OccupancyGrid, topics.NAVIGATION_MAP, self._on_map, qos.LATCHED)
        self._make_services()
        self._action = RunMissionServer(self, self._mission)
        peers = {
            "bridge": lambda: self._command.get_subscription_count() > 0,
            "frames": lambda: all(part.get_publisher_count() > 0 for part in parts),
        }
        self._diagnostics = NodeDiagnostics(self, peers)

    def destroy_node(self) -> None:
        """End the action's goal and the planner's thread, then the node."""
        if hasattr(self, "_action"):
            self._action.destroy()
        if hasattr(self, "_desk"):
            self._desk.close()
        super().destroy_node()

    def _make_services(self) -> None:
        self._serve("start", self._mission.start)
        self._serve("pause", self._mission.pause)
        self._serve("resume", self._mission.resume)
        self._serve("return_home", self._mission.return_home)
        self._serve("reset", self._reset)

    def _serve(self, name: str, action: Callable[[], bool]) -> None:
        def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
            response.success = action()
            response.message = f"{name}: {self._mission.state.name}"
            self.get_logger().info(response.message)
            return response

        self.create_service(Trigger, f"~/{name}", answer)

    def _reset(self) -> bool:
        self._mission.reset()
        self._join.clear()
        self._desk.clear()
        self._waiting.clear()
        self._action.settle()
        return True

    def _on_map(self, message: OccupancyGrid) -> None:
        self._desk.give_map(
            conversions.stamp_of(message.header.stamp), conversions.grid_of(message)
        )
        self._work()

    def _on_part(self, topic: str, message: Any) -> None:
        stamp = conversions.stamp_of(message.header.stamp)
        parts = self._join.add(topic, stamp, message)
        self._diagnostics.counts["frames_incomplete"] = self._join.dropped
        if parts is not None:
            self._waiting.append((stamp, parts))
            self._work()

    def _work(self) -> None:
        """Decide on the frames that have all they need, in their order."""
        while self._waiting and not self._desk.must_wait(self._waiting[0][0]):
            self._on_frame(*self._waiting.popleft())

    def _on_frame(self, stamp: int, parts: Parts) -> None:
        snapshot = self._snapshot(stamp, parts)
        decision = self._mission.tick(snapshot)
        now = int(self.get_clock().now().nanoseconds)
        self._command.publish(
            conversions.command_message_of(now, stamp, snapshot.vehicle.run, decision.command)
        )
        if conversions.stamp_of(parts[topics.ROCKS].map_stamp) == stamp:
            self._desk.ask(stamp, self._mission.plan_request(snapshot))
        self._diagnostics.counts["frames"] += 1
        self._report(stamp, snapshot, decision)

    def _snapshot(self, stamp: int, parts: Parts) -> Snapshot:
        return Snapshot(
            vehicle=conversions.vehicle_state_of(parts[topics.ODOMETRY], parts[topics.STATUS]),
            nav=conversions.polar_of(parts[topics.NAV_POLAR]),
            scan=conversions.scan_of(parts[topics.FREE_SCAN]),
            rocks=conversions.rocks_of(parts[topics.ROCKS]),
            plan=self._desk.plan_at(stamp),
        )

    def _report(self, stamp: int, snapshot: Snapshot, decision: Decision) -> None:
        """On every change of state, and twice a second."""
        changed = self._reported is None or self._reported[1] is not decision.state
        if changed:
            self.get_logger().info(f"{decision.state.name}: {decision.reason}")
        elif self._reported is not None and abs(stamp - self._reported[0]) < REPORT_PERIOD:
            return
        self._reported = (stamp, decision.state)
        report = mission_state_of(stamp, decision)
        self._state.publish(report)
        self._action.on_report(report)
        if self._markers.get_subscription_count() > 0:
            self._markers.publish(markers_of(stamp, snapshot, self._mission.memory))


def main() -> None:
    """Entry point of `ros2 run rover_decision decision_node`."""
    run_node(DecisionNode)
