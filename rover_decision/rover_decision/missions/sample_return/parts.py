"""What the mission remembers from frame to frame, and what its states share."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from rover_common.saved_state import Memory
from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.completion import Completion, Trigger
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.home_paths import HomePaths
from rover_decision.missions.sample_return.rover_scale import ROVER_SCALE
from rover_decision.missions.sample_return.samples import Samples
from rover_decision.trouble import Health
from rover_decision.types import Frame, Progress
from rover_navigation.actuation import Actuation
from rover_navigation.blocked_places import BlockedPlaces
from rover_navigation.breadcrumbs import Breadcrumbs
from rover_navigation.coverage import CoverageGrid
from rover_navigation.goal_history import GoalHistory
from rover_navigation.local_clearance import LocalClearance
from rover_navigation.monitors import CircleMonitor, InputMonitor, MotionMonitor
from rover_navigation.plan_scheduler import PlanStatus
from rover_navigation.recovery import SafePoses
from rover_navigation.scale import Scale
from rover_navigation.types import Plan

SAFE_TILT = 0.5  # of the limit: a pose to back to


@dataclass
class Parts:
    """Each part is one idea and knows nothing of the others."""

    config: DecisionConfig
    samples: Samples
    motion: MotionMonitor
    completion: Completion
    home_paths: HomePaths
    safe_poses: SafePoses
    goals: GoalHistory
    blocked: BlockedPlaces
    breadcrumbs: Breadcrumbs
    coverage: CoverageGrid
    actuation: Actuation = field(default_factory=lambda: Actuation(ROVER))
    inputs: InputMonitor = field(default_factory=InputMonitor)
    circle: CircleMonitor = field(default_factory=CircleMonitor)
    scale: Scale = ROVER_SCALE
    begun: float | None = None  # [s] of the first frame
    started: float | None = None  # [s] the same, of this process: it may go on with a mission
    home: tuple[float, float] = (0.0, 0.0)  # [m] where that was
    elapsed: float = 0.0  # [s] since then
    explored: float = 0.0  # 0..1, as the newest plan estimates it

    @classmethod
    def of(cls, config: DecisionConfig) -> Parts:
        """As the parameters say."""
        samples = Samples(ROVER.arm_forward, config.rock_deadline, config.retry_after)
        trigger = Trigger(config.complete_at, config.complete_rule == "all")
        goals, blocked = GoalHistory(ROVER_SCALE), BlockedPlaces(ROVER_SCALE)
        return cls(
            config=config,
            samples=samples,
            motion=MotionMonitor(config.stuck_seconds, ROVER_SCALE),
            completion=Completion(samples, goals, blocked, config.search_limit, trigger),
            home_paths=HomePaths(config.way_home),
            safe_poses=SafePoses(SAFE_TILT * config.tilt_limit, ROVER_SCALE),
            goals=goals,
            blocked=blocked,
            breadcrumbs=Breadcrumbs(ROVER_SCALE.breadcrumb_spacing),
            coverage=CoverageGrid(ROVER_SCALE),
        )

    def update(
        self, frame: Frame, plans: PlanStatus[Plan], homeward: bool
    ) -> tuple[Health, Plan | None]:
        """Once per frame: how the inputs are, and the plan in force, which is never a stale one.

        homeward: the trail and the goals no longer matter.
        """
        time, pose = frame.time, frame.pose
        if self.begun is None:
            self.begun, self.home = time, (pose.x, pose.y)
        if self.started is None:
            self.started = time
        self.elapsed = time - self.begun
        self.inputs.update(time, pose)
        self.motion.update(time, pose)
        self.safe_poses.update(pose)
        health = self._health(frame, plans)
        plan = plans.plan if health.plan_age <= self.config.plan_max_age else None
        if not homeward:
            self.breadcrumbs.drop(pose)
            self.goals.update(time, pose, plan)
        self.coverage.update(time, pose, frame.scan)
        self.samples.update(frame)
        self.blocked.update(time)
        if plan is not None:
            self.explored = plan.explored
        return health, plan

    def memory(self) -> Memory:
        """What is remembered for longer than some seconds; the arrays are copies."""
        values = {
            "begun": self.begun,
            "home": self.home,
            "explored": self.explored,
            "distance": self.inputs.distance,
            "samples": self.samples.memory(),
            "goals": self.goals.memory(),
            "blocked": self.blocked.memory(),
            "completion": self.completion.memory(),
            "home_path": self.home_paths.turn,
        }
        coverage = self.coverage.snapshot().distance
        return values, {"breadcrumbs": self.breadcrumbs.points, "coverage": coverage}

    def restore(self, memory: Memory) -> None:
        """Take what `memory` gave; raises ValueError, TypeError or KeyError for anything else."""
        values, arrays = memory
        x, y = values["home"]
        self.begun, self.home = float(values["begun"]), (float(x), float(y))
        self.explored, self.inputs.distance = float(values["explored"]), float(values["distance"])
        self.samples.restore(values["samples"])
        self.goals.restore(values["goals"])
        self.blocked.restore(values["blocked"])
        self.completion.restore(values["completion"])
        self.home_paths.turn = int(values["home_path"])
        self.breadcrumbs.restore(arrays["breadcrumbs"])
        self.coverage.restore(arrays["coverage"])

    def progress(self, frame: Frame, recoveries: int) -> Progress:
        """How far the mission has come."""
        return Progress(
            elapsed=self.elapsed,
            explored=self.explored,
            samples_total=self.samples.total,
            samples_collected=self.samples.collected,
            rocks_known=self.samples.known(frame.rocks),
            rocks_given_up=self.samples.given_up,
            home_distance=math.dist(self.home, (frame.pose.x, frame.pose.y)),
            distance=self.inputs.distance,
            recoveries=recoveries,
        )

    def local_clearance(self, frame: Frame) -> LocalClearance:
        """Of the frame's scan."""
        return LocalClearance.of(frame.scan, self.config.corridor)

    def _health(self, frame: Frame, plans: PlanStatus[Plan]) -> Health:
        started = frame.time if self.started is None else self.started
        begun = frame.stamp - round((frame.time - started) * 1e9)
        planned = begun if plans.plan is None else plans.plan.stamp
        return Health(
            tilt=max(abs(frame.pose.pitch), abs(frame.pose.roll)),
            gap=self.inputs.gap,
            jump=self.inputs.jump,
            stopped_moving=self.motion.stopped_moving(frame.time),
            plan_age=(frame.stamp - planned) * 1e-9,
            map_age=(frame.stamp - max(begun, frame.map_stamp)) * 1e-9,
            plan_failure=plans.failure,
        )
