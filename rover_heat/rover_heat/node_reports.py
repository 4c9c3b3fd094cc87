"""What heat_node tells people and other nodes of its mission."""

from __future__ import annotations

from rclpy.node import Node
from rover_interfaces.action import RunHeatMission
from rover_interfaces.msg import HeatSourceArray, HeatState
from visualization_msgs.msg import MarkerArray

from rover_common import topics
from rover_common.frames import Frames
from rover_common.ros import qos
from rover_common.types import Run
from rover_decision.mission_goal import Outcome
from rover_decision.node_action import RunMissionServer
from rover_heat.conversions import heat_sources_of, heat_state_of
from rover_heat.mission import HeatCore
from rover_heat.node_markers import markers_of
from rover_heat.types import HeatDecision, HeatSource

PERIOD = 500_000_000  # [ns] between two reports of one state
REASONS = {
    Outcome.HOME: "the mission is over",
    Outcome.CANCELED: "canceled",
    Outcome.RESTARTED: "a new run has begun",
    Outcome.FAILED: "the mission cannot go on",
}


class HeatReports:
    """State on every change and twice a second, sources on change, markers while watched."""

    def __init__(self, node: Node, core: HeatCore, frames: Frames) -> None:
        self._node = node
        self._frames = frames
        self._core = core
        self._state = node.create_publisher(HeatState, topics.HEAT_STATE, qos.LATCHED)
        self._sources = node.create_publisher(HeatSourceArray, topics.HEAT_SOURCES, qos.LATCHED)
        self._markers = node.create_publisher(MarkerArray, topics.HEAT_MARKERS, qos.VIEW)
        self.action = RunMissionServer(node, core, RunHeatMission, REASONS)
        self._last: tuple[int, int, str] | None = None  # [ns], state and reason of the last report
        self._told: tuple[int, tuple[HeatSource, ...]] | None = None  # run and sources

    def tell(self, stamp: int, run: Run, decision: HeatDecision) -> None:
        """One decision [ns]."""
        for notice in decision.notices:
            warns = notice.startswith("warning")
            log = self._node.get_logger().warning if warns else self._node.get_logger().info
            log(notice)
        self._tell_sources(stamp, run)
        state = int(decision.state)
        last = self._last
        if last is not None and last[1:] == (state, decision.reason) and stamp - last[0] < PERIOD:
            return
        if last is None or last[1] != state:
            self._node.get_logger().info(f"{decision.state.name}: {decision.reason}")
        self._last = (stamp, state, decision.reason)
        report = heat_state_of(stamp, run, decision, self._frames)
        self._state.publish(report)
        self.action.on_report(report)
        if self._markers.get_subscription_count() > 0:
            overlay = self._core.mission.overlay()
            self._markers.publish(markers_of(stamp, overlay, self._frames))

    def _tell_sources(self, stamp: int, run: Run) -> None:
        told = run.number, self._core.mission.overlay().sources
        if told != self._told:
            self._told = told
            self._sources.publish(heat_sources_of(stamp, run, told[1], self._frames))
