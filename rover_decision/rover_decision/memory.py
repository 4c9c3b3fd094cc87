"""What a mission remembers from frame to frame."""

from __future__ import annotations

import math
from collections import deque
from functools import partial

from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_common.vehicle import ARM_FORWARD
from rover_decision.config import DecisionConfig
from rover_decision.rocks import RockMemory, Target
from rover_decision.types import Progress, Snapshot
from rover_navigation.breadcrumbs import Crumbs
from rover_navigation.costmap import Blocked
from rover_navigation.goal_history import GoalMemory
from rover_navigation.monitors import (
    CircleMonitor,
    HeldMonitor,
    Odometer,
    ProgressMonitor,
    SearchedGround,
)
from rover_navigation.plan_scheduler import MakeRequest
from rover_navigation.recovery import Ladder, SafePoses
from rover_navigation.types import GoalKind, PlanRequest

ON_ONE_SPOT = 25.0  # [s] of turning and looking; no more than two full turns are of use
BLOCK_AHEAD, BLOCK_RADIUS = 1.0, 0.5  # [m] where there was no way on
BLOCK_SECONDS, STOP_BLOCK_SECONDS = 90.0, 8.0  # [s] where it got stuck, or stopped in vain
STOPS_HERE = 3  # of them mean that what is in the way is not on the map
SAME_STOP, SAME_STOP_SECONDS = 1.0, 15.0  # [m] [s] within which they are
SEARCH_PERIOD = 0.2  # [s] between two looks at what was searched


class Memory:
    """Updated once per frame; from then on the same until the next."""

    def __init__(self, config: DecisionConfig, snapshot: Snapshot) -> None:
        pose = snapshot.vehicle.pose
        self._rock_deadline = config.rock_deadline
        self._search_limit = config.search_limit
        self._search_seconds = 0.0
        self.time = snapshot.time  # [s] of the newest frame
        self.pose = pose  # there
        self.gap = self.jump = 0.0  # [s] [m] from the frame before to the newest
        self.start_time = snapshot.time
        self.home = (pose.x, pose.y)
        self.samples_total = snapshot.vehicle.sample_count
        self._sample_count = self.samples_total
        self.progress = ProgressMonitor(config.stuck_seconds)
        self.travel = ProgressMonitor(ON_ONE_SPOT, turns_count=False)
        self.held = HeldMonitor()
        self.circle = CircleMonitor()
        self.odometer = Odometer()
        self.rocks = RockMemory(config.retry_after)
        self.goals = GoalMemory()
        self.ladder = Ladder()
        self.safe_poses = SafePoses(config.tilt_limit)
        self.safe_pose: Pose | None = None  # to back to from where it tilted last
        self.arm_worked = False  # since the mission asked for it last
        self.crumbs = Crumbs()
        self.blocked: tuple[Blocked, ...] = ()
        self.recoveries = 0
        self._stops: deque[tuple[float, Pose]] = deque(maxlen=STOPS_HERE)  # [s] and where
        self._searched = SearchedGround()
        self._searched_at = -math.inf  # [s]
        self._explored = 0.0
        self._looked_again = False

    def update(self, snapshot: Snapshot, on_the_way_home: bool) -> None:
        vehicle, time = snapshot.vehicle, snapshot.time
        goal = None if snapshot.plan is None else snapshot.plan.goal
        if goal is not None and goal.kind is GoalKind.SEARCH:
            self._search_seconds += max(0.0, time - self.time)
        self.gap = time - self.time
        self.jump = math.hypot(vehicle.pose.x - self.pose.x, vehicle.pose.y - self.pose.y)
        self.time, self.pose = time, vehicle.pose
        self.arm_worked |= vehicle.picking_up
        self.odometer.update(vehicle.pose)
        self.progress.update(time, vehicle.pose)
        self.travel.update(time, vehicle.pose)
        self.safe_poses.update(vehicle.pose)
        if not on_the_way_home:
            self.crumbs.drop(vehicle.pose)
            self.goals.update(time, vehicle.pose, snapshot.plan)
        if time - self._searched_at >= SEARCH_PERIOD:
            self._searched_at = time
            self._searched.update(vehicle.pose, snapshot.scan)
        if vehicle.sample_count < self._sample_count:
            pose = vehicle.pose
            self.rocks.collect(
                pose.x + ARM_FORWARD * math.cos(pose.yaw), pose.y + ARM_FORWARD * math.sin(pose.yaw)
            )
        self._sample_count = vehicle.sample_count
        self.blocked = tuple(place for place in self.blocked if place.until > time)
        if snapshot.plan is not None:
            self._explored = snapshot.plan.explored

    def block(self, pose: Pose, ahead: float, radius: float, until: float) -> None:
        """Remember a place [m] ahead of a pose as impassable until a time [s]."""
        x = pose.x + ahead * math.cos(pose.yaw)
        y = pose.y + ahead * math.sin(pose.yaw)
        self.blocked = (*self.blocked, Blocked(x, y, radius, until))

    def block_ahead(self, time: float, pose: Pose, seconds: float = BLOCK_SECONDS) -> None:
        """There was no way on at a pose, at a time [s]: for a while."""
        self.block(pose, BLOCK_AHEAD, BLOCK_RADIUS, time + seconds)

    def unblock(self) -> bool:
        """Forget what was blocked for a while; whether there was any such place."""
        standing = tuple(place for place in self.blocked if not math.isfinite(place.until))
        unblocked = len(standing) < len(self.blocked)
        self.blocked = standing
        return unblocked

    def stopped(self, time: float, pose: Pose) -> None:
        """No way ahead. When it is so here again and again, the place counts as blocked."""
        self._stops.append((time, pose))
        near = [
            time - before < SAME_STOP_SECONDS
            and math.hypot(pose.x - place.x, pose.y - place.y) < SAME_STOP
            for before, place in self._stops
        ]
        if len(near) == STOPS_HERE and all(near):
            self.block_ahead(time, pose, STOP_BLOCK_SECONDS)

    def second_look(self, snapshot: Snapshot) -> bool:
        """Before it is all over: doubt what was given up; while samples are missing, forget it.

        Whether there is anything to be tried once more; only once in a mission, so that it ends.
        """
        if self._looked_again:
            return False
        self._looked_again = True
        unblocked = self.unblock()
        if self.all_collected(snapshot):
            unvisited = self.goals.doubt_visited(snapshot.time)
        else:
            unvisited = self.goals.forget_visited()
        self.goals.await_plans()
        return unblocked or unvisited

    def target(self, snapshot: Snapshot) -> Target | None:
        """The nearest rock worth going for."""
        if self.all_collected(snapshot):
            return None
        return self.rocks.nearest(snapshot.rocks, snapshot.vehicle.pose, snapshot.time)

    def approach(self, snapshot: Snapshot) -> None:
        """A frame went into getting to the nearest rock, which is given up after its deadline."""
        target = self.target(snapshot)
        if target is not None:
            self.rocks.spend(target.rock, self.gap)
            if self.rocks.spent(target.rock) > self._rock_deadline:
                self.rocks.give_up(target.rock, snapshot.time)

    def all_collected(self, snapshot: Snapshot) -> bool:
        return self.samples_total > 0 and snapshot.vehicle.sample_count == 0

    def elapsed(self, snapshot: Snapshot) -> float:
        return snapshot.time - self.start_time

    def home_distance(self, pose: Pose) -> float:
        return math.hypot(pose.x - self.home[0], pose.y - self.home[1])

    def request(self, snapshot: Snapshot, home_by_crumbs: bool) -> MakeRequest:
        """What a plan is to be made of, as things stand at this frame; the map comes later."""
        vehicle, time = snapshot.vehicle, snapshot.time
        collected = self.all_collected(snapshot)
        rocks = () if collected else self.rocks.worth_going(snapshot.rocks, time)
        make = partial(
            PlanRequest,
            stamp=vehicle.stamp,
            pose=vehicle.pose,
            home=self.home,
            trail=self.crumbs.points,
            rocks=rocks,
            blocked=self.blocked,
            visited=self.goals.visited(time),
            doubtful=self.goals.doubtful(time),
            searched=self._searched.so_far(),
            search=not collected and self._search_seconds < self._search_limit,
            last_goal=self.goals.last,
            home_by_crumbs=home_by_crumbs,
        )

        def with_map(grid: GridMap) -> PlanRequest:
            return make(grid=grid)

        return with_map

    def report(self, snapshot: Snapshot) -> Progress:
        return Progress(
            elapsed=self.elapsed(snapshot),
            explored=self._explored,
            samples_total=self.samples_total,
            samples_collected=max(0, self.samples_total - snapshot.vehicle.sample_count),
            rocks_known=self.rocks.left(snapshot.rocks),
            rocks_given_up=self.rocks.given_up,
            home_distance=self.home_distance(snapshot.vehicle.pose),
            distance=self.odometer.distance,
            recoveries=self.recoveries,
        )
