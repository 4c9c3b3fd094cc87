"""Snapshots for the mission, and a planar rover that drives on a drawn map with ideal senses."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import Command, FreeScan, GridMap, PolarArray, RockTrack, VehicleState
from rover_common.vehicle import (
    ARM_FORWARD,
    ARM_RADIUS,
    MAX_STEERING,
    PICKUP_SECONDS,
    TURN_IN_PLACE_BELOW,
    TURN_IN_PLACE_RATE,
    WHEELBASE,
)
from rover_decision.config import DecisionConfig
from rover_decision.mission import Mission
from rover_decision.states import State
from rover_decision.types import Decision, Snapshot
from rover_navigation.plan_scheduler import PlanDesk
from rover_navigation.planner import Planner
from rover_navigation.types import NO_WAY, Goal, GoalKind, Plan, Way

PERIOD = 0.05  # [s]
PLAN_PERIOD = 0.5  # [s]
RANGE = 12.0  # [m]
CELL = 0.25  # [m] of the map
MIDDLE = Pose(100.0, 100.0, 0.0)
BEARINGS = np.radians(np.arange(-54, 55))


def snapshot(
    time: float = 1.0,
    pose: Pose = MIDDLE,
    ahead: float = RANGE,
    rocks: tuple[RockTrack, ...] = (),
    speed: float = 0.0,
    near_sample: bool = False,
    picking_up: bool = False,
    sample_count: int = 3,
    plan: Plan | None = None,
) -> Snapshot:
    """Open ground for `ahead` [m] in every direction."""
    scan = FreeScan(
        float(BEARINGS[0]), math.radians(1), 0.75, RANGE, np.full(len(BEARINGS), ahead, np.float32)
    )
    return _snapshot(time, pose, speed, scan, rocks, near_sample, picking_up, sample_count, plan)


def straight_plan(
    length: float = 20.0, pose: Pose = MIDDLE, stamp: int = 0, goal: bool = True
) -> Plan:
    """To a frontier straight ahead; home lies straight behind."""
    steps = np.arange(0.5, length, 0.5)
    ahead = np.stack(
        [pose.x + steps * math.cos(pose.yaw), pose.y + steps * math.sin(pose.yaw)], axis=1
    )
    back = 2 * np.array([(pose.x, pose.y)]) - ahead
    speeds = np.full(len(steps), 3.0)
    to = Goal(GoalKind.FRONTIER, float(ahead[-1, 0]), float(ahead[-1, 1])) if goal else None
    way = Way(ahead, speeds) if goal else NO_WAY
    return Plan(stamp, to, way, Way(back, speeds), 10.0, np.empty((0, 2)), 0.5)


def rock(x: float, y: float, number: int = 1) -> RockTrack:
    return RockTrack(number, x, y, (0.01, 0.0, 0.0, 0.01), 10, 0)


class PlanarRover:
    """The measured planar model on a map of cells, without a camera."""

    def __init__(
        self, navigable: NDArray[np.bool_], start: Pose, samples: list[tuple[float, float]]
    ) -> None:
        self._navigable = navigable
        self.pose = start
        self.speed = 0.0
        self.samples = list(samples)
        self.time = 1.0
        self.unsafe_pickups = 0
        self._pickup_until = 0.0
        self._cells = GridGeometry.of_world(CELL)
        self._known = np.zeros((self._cells.rows, self._cells.cols), bool)

    def look(self, plan: Plan | None = None) -> Snapshot:
        """What ideal senses would say."""
        picking_up = self.time < self._pickup_until
        rocks = tuple(
            rock(x, y, number)
            for number, (x, y) in enumerate(self.samples)
            if self._distance(x, y) < 8.0
        )
        near = self._sample_in_reach() is not None
        speed = 0.0 if picking_up else self.speed
        return _snapshot(
            self.time,
            self.pose,
            speed,
            self._scan(),
            rocks,
            near,
            picking_up,
            len(self.samples),
            plan,
        )

    def map(self) -> GridMap:
        """All cells that it has had in view."""
        reach = round(RANGE / CELL)
        row0, col0 = self._cells.cell_of(self.pose.x, self.pose.y)
        steps = np.arange(-reach, reach + 1)
        row, col = np.meshgrid(row0 + steps, col0 + steps, indexing="ij")
        x, y = self._cells.center_of(row, col)
        distance = np.hypot(x - self.pose.x, y - self.pose.y)
        bearing = np.arctan2(y - self.pose.y, x - self.pose.x) - self.pose.yaw
        bearing = np.angle(np.exp(1j * bearing))
        ray = np.clip(np.round(np.degrees(bearing)) + 54, 0, 108).astype(int)
        seen = (np.abs(bearing) < math.radians(54)) & (distance < self._scan().ranges[ray] + 0.5)
        seen &= distance < RANGE
        self._known[row[seen], col[seen]] = True
        truth = np.kron(self._navigable, np.ones((4, 4), bool))
        cells = np.where(self._known, np.where(truth, 0, 100), -1).astype(np.int8)
        return GridMap(CELL, 0.0, 0.0, cells)

    def step(self, command: Command) -> None:
        """One frame of driving."""
        self.time += PERIOD
        if self.time - PERIOD < self._pickup_until <= self.time:
            sample = self._sample_in_reach()
            assert sample is not None
            self.samples.remove(sample)
        if self.time < self._pickup_until:
            return
        if command.pickup:
            if self._sample_in_reach() is None:
                self.unsafe_pickups += 1
            else:
                self._pickup_until, self.speed = self.time + PICKUP_SECONDS, 0.0
            return
        self._drive(command)

    def _drive(self, command: Command) -> None:
        steering = max(-MAX_STEERING, min(MAX_STEERING, command.steering_angle))
        idle = command.throttle == 0 and command.brake == 0
        if idle and steering and abs(self.speed) < TURN_IN_PLACE_BELOW:
            self._move(0.0, TURN_IN_PLACE_RATE * steering * PERIOD)
            self.speed = 0.0
            return
        self.speed += (0.852 * command.throttle - 0.0574 * self.speed) * PERIOD
        brake = min(3.0 * command.brake, 2.5) * PERIOD
        self.speed = math.copysign(max(0.0, abs(self.speed) - brake), self.speed)
        self.speed = max(-2.0, min(5.0, self.speed))
        wheel = steering * (1.0 - 0.667 * min(1.0, abs(self.speed) / 5.0))
        turn = self.speed * math.tan(wheel) / WHEELBASE
        self._move(self.speed * PERIOD, turn * PERIOD)

    def _move(self, distance: float, turn: float) -> None:
        yaw = self.pose.yaw + turn
        x = self.pose.x + distance * math.cos(yaw)
        y = self.pose.y + distance * math.sin(yaw)
        if self._navigable[int(y), int(x)]:
            self.pose = Pose(x, y, yaw)
        else:  # the wall holds it
            self.pose, self.speed = Pose(self.pose.x, self.pose.y, yaw), 0.0

    def _scan(self) -> FreeScan:
        steps = np.arange(0.75, RANGE, 0.1)
        angle = self.pose.yaw + BEARINGS[:, None]
        col = np.clip(self.pose.x + steps * np.cos(angle), 0, 199).astype(int)
        row = np.clip(self.pose.y + steps * np.sin(angle), 0, 199).astype(int)
        blocked = ~self._navigable[row, col]
        first = np.where(blocked.any(axis=1), steps[blocked.argmax(axis=1)], np.inf)
        return FreeScan(float(BEARINGS[0]), math.radians(1), 0.75, RANGE, first.astype(np.float32))

    def _sample_in_reach(self) -> tuple[float, float] | None:
        arm_x = self.pose.x + ARM_FORWARD * math.cos(self.pose.yaw)
        arm_y = self.pose.y + ARM_FORWARD * math.sin(self.pose.yaw)
        for x, y in self.samples:
            if math.hypot(x - arm_x, y - arm_y) < ARM_RADIUS:
                return x, y
        return None

    def _distance(self, x: float, y: float) -> float:
        return math.hypot(x - self.pose.x, y - self.pose.y)


def _snapshot(
    time: float,
    pose: Pose,
    speed: float,
    scan: FreeScan,
    rocks: tuple[RockTrack, ...],
    near_sample: bool,
    picking_up: bool,
    sample_count: int,
    plan: Plan | None,
) -> Snapshot:
    stamp = round(time * 1e9)
    ranges = np.minimum(scan.ranges, RANGE)
    # each bearing holds as many ground cells as its free length
    bearings = np.repeat(BEARINGS, (4 * ranges).astype(int)).astype(np.float32)
    nav = PolarArray(np.ones_like(bearings), bearings)
    vehicle = VehicleState(stamp, pose, speed, near_sample, picking_up, sample_count)
    return Snapshot(vehicle, nav, scan, rocks, plan)


def fly(rover: PlanarRover, config: DecisionConfig, time_limit: float) -> tuple[Mission, Decision]:
    """Until the mission is over or the time [s] is up, with a plan twice a second."""
    mission = Mission(config)
    desk = PlanDesk(Planner(config.explorer).plan, config.plan_delay, lockstep=True)
    planned = -1.0
    try:
        while True:
            stamp = round(rover.time * 1e9)
            snapshot = rover.look(desk.plan_at(stamp))
            decision = mission.tick(snapshot)
            if mission.state is State.DONE or rover.time > time_limit:
                return mission, decision
            if rover.time - planned >= PLAN_PERIOD:
                planned = rover.time
                desk.ask(stamp, mission.plan_request(snapshot))
                desk.give_map(stamp, rover.map())
            rover.step(decision.command)
    finally:
        desk.close()
