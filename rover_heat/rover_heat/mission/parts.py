"""What the mission remembers from tick to tick, and what its states share."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from rover_common.geometry import Pose
from rover_common.sensor_types import LaserScan, ThermalFrame
from rover_decision.trouble import Health
from rover_heat.config import HeatConfig
from rover_heat.inputs import JUMP, InputWatch
from rover_heat.mission.agenda import Agenda
from rover_heat.mission.back_track import BackTrack
from rover_heat.mission.goal_book import GoalBook
from rover_heat.mission.ownership import CommandOwner
from rover_heat.mission.ramp_book import RampBook
from rover_heat.mission.source_book import SourceBook
from rover_heat.mission.trip import Trip
from rover_heat.mission.wheel_slip import WheelSlip
from rover_heat.planning.types import HeatPlan
from rover_heat.thermal.sensing import ThermalSensing
from rover_heat.tilt import FIT_TILT, TiltMonitor
from rover_heat.types import HeatFrame
from rover_navigation.breadcrumbs import Breadcrumbs
from rover_navigation.navigator import Navigator
from rover_navigation.plan_scheduler import PlanStatus

CELL = 0.05  # [m] of the map
TRAIL = 0.10  # [m] between points of the trail
FORGET = 1.0  # [s] of fixes that a jump of the pose makes void
SEQUENCE_SECONDS = 15.0  # [s] of a launch without a report, after which it counts as done
SLACK = 0.01  # [s] that a tick may come early


@dataclass
class HeatParts:
    """Each part is one idea and knows nothing of the others, but the agenda."""

    config: HeatConfig
    navigator: Navigator
    tilt: TiltMonitor
    sensing: ThermalSensing
    sources: SourceBook
    ramps: RampBook
    agenda: Agenda
    goals: GoalBook
    trip: Trip
    track: BackTrack
    inputs: InputWatch = field(default_factory=InputWatch)
    owner: CommandOwner = field(default_factory=CommandOwner)
    slip: WheelSlip = field(default_factory=WheelSlip)
    trail: Breadcrumbs = field(default_factory=lambda: Breadcrumbs(TRAIL))
    begun: float | None = None  # [s] of the first tick
    time_limit: float = math.inf  # [s] of mission time
    start: Pose | None = None  # where the robot was at first
    navigator_seen: float = -math.inf  # [s] when it was last ready
    launcher_works_until: float = -math.inf  # [s] at most: only a restart asks for it
    plan_stamp: int = -1  # [ns] of the newest plan
    plan_since: float = 0.0  # [s] from when on plans are expected
    scan: LaserScan | None = None  # the newest
    notices: list[str] = field(default_factory=list)  # of this tick, for the log
    _scans: tuple[LaserScan, ...] = ()  # not yet sensed
    _thermal: tuple[ThermalFrame, ...] = ()
    _sense_at: float = -math.inf  # [s]

    @classmethod
    def of(cls, config: HeatConfig, navigator: Navigator) -> HeatParts:
        """As the parameters say."""
        tilt, sources, ramps = TiltMonitor(config), SourceBook(config), RampBook(config.ramp_length)
        return cls(
            config=config,
            navigator=navigator,
            tilt=tilt,
            sensing=ThermalSensing(config, tilt),
            sources=sources,
            ramps=ramps,
            agenda=Agenda(config, sources, ramps, config.payloads),
            goals=GoalBook(CELL, config.rate_of_placement),
            trip=Trip(navigator),
            track=BackTrack(config.ramp_backtrack),
            time_limit=config.time_limit,
        )

    def update(self, frame: HeatFrame, plans: PlanStatus[HeatPlan]) -> Health:
        """Once per tick."""
        time, pose = frame.time, frame.pose
        if self.begun is None:
            self.begun = self.plan_since = time
        self.scan = frame.scans[-1] if frame.scans else self.scan
        self.inputs.update(frame)
        self.tilt.update(frame.imus)
        self._sense(frame)
        if frame.launches_done > 0:
            self.launcher_works_until = -math.inf
        if self.inputs.jump > JUMP:
            self.sensing.forget_since(time - FORGET)
        if self.navigator.is_ready:
            self.navigator_seen = time
        if pose is not None:
            self.start = self.start or pose
            self.slip.update(time, pose, frame.twist.linear)
            level = self.tilt.lean.slope < FIT_TILT
            self.track.update(pose, level)
            self.trail.drop(pose)
        self.agenda.update((time - self.begun) / self.time_limit)
        return self._health(frame, plans)

    def spend_payload(self, time: float) -> None:
        """The launcher is signalled at a time [s]."""
        self.agenda.payloads -= 1
        self.launcher_works_until = time + SEQUENCE_SECONDS

    def _sense(self, frame: HeatFrame) -> None:
        """At the fast rate: scans and thermal frames of the ticks since the last time."""
        self._scans += frame.scans
        self._thermal += frame.thermal
        if frame.time < self._sense_at:
            self.sensing.views = []
            return
        self._sense_at = frame.time + 1.0 / self.config.fast_rate - SLACK
        self.sensing.update(replace(frame, scans=self._scans, thermal=self._thermal))
        self._scans, self._thermal = (), ()
        for source in self.sources.note_views(self.sensing.views):
            self.sensing.forget_near(source.x, source.y, self.config.group_distance)
            self.notices.append(f"source {source.id} is cold from near: dropped")

    def take_plan(self, plan: HeatPlan | None) -> bool:
        """Whether the plan in force is a new one; what it says is noted."""
        if plan is None or plan.stamp == self.plan_stamp:
            return False
        self.plan_stamp = plan.stamp
        self.sources.update(plan)
        self.ramps.update(plan)
        return True

    def _health(self, frame: HeatFrame, plans: PlanStatus[HeatPlan]) -> Health:
        newest = self.plan_since if plans.plan is None else plans.plan.stamp * 1e-9
        age = frame.time - max(newest, self.plan_since)
        return Health(
            tilt=self.tilt.share,
            gap=self.inputs.overdue,
            jump=self.inputs.jump,
            stopped_moving=self.slip.slips,
            plan_age=age,
            map_age=0.0,
            plan_failure=plans.failure,
            clock_error=self.inputs.clock_error,
            navigator_silent=frame.time - self.navigator_seen,
        )
