"""The mission: what happened, what follows from it, and what to do; one tick per frame."""

from __future__ import annotations

import math

import numpy as np

from rover_common.dataflow import SAFE_COMMAND, Command
from rover_common.geometry import Pose
from rover_common.vehicle import ARM_FORWARD
from rover_decision import behaviours
from rover_decision.config import DecisionConfig
from rover_decision.crumbs import Crumbs
from rover_decision.dataflow import Decision, Progress, Snapshot
from rover_decision.observers import Odometer, ProgressMonitor
from rover_decision.rocks import RockMemory, Target
from rover_decision.states import Event, Machine, State
from rover_decision.terrain import Terrain

PICKUP_START_SECONDS = 4.0  # [s] for a pickup to show in the telemetry after it was asked for
RECOVERY_SECONDS = behaviours.BACK_UP_SECONDS + behaviours.TURN_SECONDS
WAY_AHEAD = math.radians(8.0)  # a way this near to straight ahead can be driven into
RESTART_SECONDS = 5.0  # [s] of time falling back: a new run has begun
MOVING_STATES = (State.FORWARD, State.STOP, State.ROCK_APPROACH, State.RETURN_HOME)


class Mission:
    """Holds the machine and what the mission remembers."""

    def __init__(self, config: DecisionConfig) -> None:
        self._config = config
        self.reset()

    def reset(self) -> None:
        """Forget everything: the next frame starts a new mission."""
        self._machine = Machine()
        self._entered = 0.0  # [s] when the state was entered
        self._resume_to: State | None = None
        self._start: tuple[float, Pose] | None = None
        self._time = 0.0
        self._samples_total = 0
        self._sample_count: int | None = None
        self._pickup_seen = False
        self._side = 1  # of the next turn away from an obstacle, +1 left
        self._progress = ProgressMonitor(self._config.stuck_seconds)
        self._odometer = Odometer()
        self._rocks = RockMemory(self._config.retry_after)
        self._way: np.ndarray = np.empty((0, 2))
        self.crumbs = Crumbs()

    @property
    def state(self) -> State:
        return self._machine.state

    def pause(self) -> bool:
        """Whether the mission could be paused."""
        return self._machine.handle(Event.pause)

    def resume(self) -> bool:
        """Whether the mission was paused and goes on."""
        return self._machine.handle(Event.resume)

    def return_home(self) -> bool:
        """Whether the mission turns home."""
        self._way = np.empty((0, 2))
        return self._machine.handle(Event.finished)

    def tick(self, snapshot: Snapshot) -> Decision:
        """Decide about one frame."""
        if snapshot.time < self._time - RESTART_SECONDS:
            self.reset()
        self._time = snapshot.time
        self._remember(snapshot)
        terrain = Terrain.of(snapshot.scan, self._config.corridor)
        target = self._target(snapshot)
        event = self._what_happened(snapshot, terrain, target)
        if event is not None and self._machine.handle(event):
            self._on_entry(snapshot, terrain)
        command, reason = self._act(snapshot, terrain, target)
        return Decision(command, self.state, reason, self._report(snapshot))

    def _remember(self, snapshot: Snapshot) -> None:
        vehicle = snapshot.vehicle
        if self._start is None:
            self._start = (snapshot.time, vehicle.pose)
            self._samples_total = vehicle.sample_count
        self._odometer.update(vehicle.pose)
        if self.state not in (State.RETURN_HOME, State.DONE):
            self.crumbs.drop(vehicle.pose)
        if self._sample_count is not None and vehicle.sample_count < self._sample_count:
            pose = vehicle.pose
            self._rocks.collect(
                pose.x + ARM_FORWARD * math.cos(pose.yaw), pose.y + ARM_FORWARD * math.sin(pose.yaw)
            )
        self._sample_count = vehicle.sample_count
        self._progress.update(snapshot.time, vehicle.pose)

    def _target(self, snapshot: Snapshot) -> Target | None:
        target = self._rocks.nearest(snapshot.rocks, snapshot.vehicle.pose, snapshot.time)
        if target is None or target.distance > self._config.rock_range:
            return None
        return target

    def _what_happened(
        self, snapshot: Snapshot, terrain: Terrain, target: Target | None
    ) -> Event | None:
        """The first that applies, the most urgent first."""
        state, since = self.state, snapshot.time - self._entered
        if state is State.IDLE:
            return Event.start
        if state is State.PICKUP:
            return self._pickup_event(snapshot, since)
        if state in (State.STUCK, State.TILT):
            return Event.recovered if since > RECOVERY_SECONDS else None
        if state not in MOVING_STATES:
            return None
        return (
            self._trouble(snapshot)
            or self._rock_event(snapshot, target, since)
            or self._way_event(snapshot, terrain)
        )

    def _pickup_event(self, snapshot: Snapshot, since: float) -> Event | None:
        vehicle = snapshot.vehicle
        if vehicle.picking_up:
            self._pickup_seen = True
            return None
        if self._pickup_seen:
            return Event.picked_up
        return Event.pickup_failed if since > PICKUP_START_SECONDS else None

    def _trouble(self, snapshot: Snapshot) -> Event | None:
        pose = snapshot.vehicle.pose
        if max(abs(pose.pitch), abs(pose.roll)) > self._config.tilt_limit:
            return Event.tilted
        return Event.stopped_moving if self._progress.stuck() else None

    def _rock_event(self, snapshot: Snapshot, target: Target | None, since: float) -> Event | None:
        vehicle = snapshot.vehicle
        if vehicle.near_sample and not vehicle.picking_up and abs(vehicle.speed) < 1.0:
            return Event.rock_reached
        if self.state is not State.ROCK_APPROACH:
            return None if target is None else Event.rock_seen
        if target is None:
            return Event.rock_lost
        if since > self._config.rock_deadline:
            self._rocks.give_up(target.rock, snapshot.time)
            return Event.rock_lost
        return None

    def _way_event(self, snapshot: Snapshot, terrain: Terrain) -> Event | None:
        if self.state is State.RETURN_HOME:
            home = self._home_distance(snapshot.vehicle.pose) < self._config.home_radius
            return Event.arrived if home else None
        if self._finished(snapshot):
            return Event.finished
        if self.state is State.FORWARD:
            blocked = terrain.clearance(0.0) < self._config.stop_clearance
            return Event.blocked if blocked else None
        way = terrain.way(self._config.go_clearance)
        ahead = way is not None and abs(way) < WAY_AHEAD
        return Event.cleared if self.state is State.STOP and ahead else None

    def _finished(self, snapshot: Snapshot) -> bool:
        collected = self._samples_total > 0 and snapshot.vehicle.sample_count == 0
        return collected or self._elapsed(snapshot) > self._config.explore_limit

    def _on_entry(self, snapshot: Snapshot, terrain: Terrain) -> None:
        self._entered = snapshot.time
        self._pickup_seen = False
        self._progress.restart()
        if self.state is State.STOP:
            self._side = terrain.roomier_side()
        if self.state is State.STUCK:
            self._side = -self._side  # what was tried before did not help
        if self.state is State.RETURN_HOME:
            self._way = behaviours.plan_home(self.crumbs, snapshot.vehicle.pose)

    def _act(
        self, snapshot: Snapshot, terrain: Terrain, target: Target | None
    ) -> tuple[Command, str]:
        since = snapshot.time - self._entered
        match self.state:
            case State.FORWARD:
                return behaviours.explore(snapshot, terrain, self._config)
            case State.STOP:
                return behaviours.look_for_a_way(snapshot, terrain, self._side, self._config)
            case State.ROCK_APPROACH:
                return behaviours.approach(snapshot, target)
            case State.PICKUP:
                return behaviours.pick_up(snapshot)
            case State.STUCK:
                return behaviours.back_off(snapshot, since, self._side)
            case State.TILT:
                return behaviours.back_off(snapshot, since, self._side)
            case State.RETURN_HOME:
                self._way = behaviours.remaining_way(self._way, snapshot.vehicle.pose)
                return behaviours.go_home(snapshot, terrain, self._way, self._config)
            case State.DONE:
                return SAFE_COMMAND, "the mission is over"
            case State.PAUSED:
                return SAFE_COMMAND, "paused"
            case _:
                return SAFE_COMMAND, "waits for the first frame"

    def _elapsed(self, snapshot: Snapshot) -> float:
        return 0.0 if self._start is None else snapshot.time - self._start[0]

    def _home_distance(self, pose: Pose) -> float:
        if self._start is None:
            return 0.0
        home = self._start[1]
        return math.hypot(pose.x - home.x, pose.y - home.y)

    def _report(self, snapshot: Snapshot) -> Progress:
        return Progress(
            elapsed=self._elapsed(snapshot),
            samples_total=self._samples_total,
            samples_collected=max(0, self._samples_total - snapshot.vehicle.sample_count),
            rocks_known=self._rocks.wanted(snapshot.rocks),
            rocks_given_up=self._rocks.given_up,
            home_distance=self._home_distance(snapshot.vehicle.pose),
            distance=self._odometer.distance,
        )
