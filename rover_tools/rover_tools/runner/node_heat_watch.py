"""Observes the heat mission's running graph from outside: states, poses, sources, map."""

from __future__ import annotations

import time
from dataclasses import dataclass

from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rover_interfaces.msg import HeatSourceArray, HeatState
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from rover_common import topics
from rover_common.errors import RoverError
from rover_common.frames import BASE_FOOTPRINT, MAP, ODOM, bare
from rover_common.geometry import Pose
from rover_common.ros import conversions, qos
from rover_common.ros.transforms import pose_of_transform
from rover_common.types import GridMap
from rover_heat.mission.chart import State
from rover_heat.types import HeatSource
from rover_tools.report.recorded_places import sources_of
from rover_tools.runner.node_diagnostics import DiagnosticsWatch

SIMULATOR = "burger_node"
# As LATCHED, and no state is missed between two looks.
ALL_STATES = QoSProfile(
    depth=100,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
RESUME_SECONDS = 10.0  # [s] for the simulator to answer
Stamped = tuple[int, Pose]  # [ns]


class ResumeError(RoverError):
    """The simulator did not begin."""


@dataclass(frozen=True)
class StateReport:
    """The mission's state at one tick."""

    stamp: int  # [ns]
    state: State
    reason: str
    elapsed: float  # [s]
    explored: float  # 0..1
    interrupts: int
    sources_known: int
    sources_delivered: int


class HeatWatch(DiagnosticsWatch):
    """What it holds may be read from any thread."""

    def __init__(self, domain_id: int) -> None:
        super().__init__(domain_id)
        self.reports: list[StateReport] = []
        self.corrections: list[Stamped] = []  # of odom in the map
        self.odometry: list[Stamped] = []  # of base_footprint in odom
        self._grid: OccupancyGrid | None = None
        self._sources = HeatSourceArray()
        subscribe = self.node.create_subscription
        subscribe(HeatState, topics.HEAT_STATE, self._on_state, ALL_STATES)
        subscribe(HeatSourceArray, topics.HEAT_SOURCES, self._on_sources, qos.LATCHED)
        subscribe(OccupancyGrid, topics.MAP, self._on_map, qos.LATCHED)
        subscribe(TFMessage, "/tf", self._on_transform, qos.TF)
        self._resume = self.node.create_client(Trigger, f"{SIMULATOR}/resume")
        self.start()

    @property
    def newest(self) -> StateReport | None:
        return self.reports[-1] if self.reports else None

    @property
    def grid(self) -> GridMap | None:
        """The newest map."""
        return None if self._grid is None else conversions.grid_of(self._grid)

    @property
    def sources(self) -> tuple[HeatSource, ...]:
        return sources_of(self._sources)

    def resume_simulator(self) -> None:
        """Let the simulated time begin; raises ResumeError."""
        end = time.monotonic() + RESUME_SECONDS
        found = self._resume.wait_for_service(RESUME_SECONDS)
        answer = self._resume.call_async(Trigger.Request()) if found else None
        while answer is not None and not answer.done() and time.monotonic() < end:
            time.sleep(0.01)
        if answer is None or not answer.done():
            raise ResumeError(f"{SIMULATOR} did not answer within {RESUME_SECONDS:.0f} s")

    def _on_state(self, message: HeatState) -> None:
        self.reports.append(
            StateReport(
                conversions.stamp_of(message.header.stamp),
                State(message.state),
                message.reason,
                message.elapsed,
                message.explored,
                message.interrupts,
                message.sources_known,
                message.sources_delivered,
            )
        )

    def _on_sources(self, message: HeatSourceArray) -> None:
        self._sources = message

    def _on_map(self, message: OccupancyGrid) -> None:
        self._grid = message

    def _on_transform(self, link: TransformStamped) -> None:
        stamped = conversions.stamp_of(link.header.stamp), pose_of_transform(link)
        pair = bare(link.header.frame_id), bare(link.child_frame_id)
        if pair == (MAP, ODOM):
            self.corrections.append(stamped)
        elif pair == (ODOM, BASE_FOOTPRINT):
            self.odometry.append(stamped)
