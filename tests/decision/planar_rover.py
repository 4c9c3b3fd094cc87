"""A planar rover that drives on a drawn map with ideal sensors, and whole missions of it."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from frames_by_hand import frame_of, nanoseconds, rock
from numpy.typing import NDArray
from scans import BEARINGS, RANGE, scan_of

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import FIRST_RUN, Command, FreeScan, GridMap, Run, VehicleState
from rover_common.vehicle import ROVER
from rover_decision.core import DecisionCore
from rover_decision.missions.sample_return import make_core
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Decision, Frame

PERIOD = 0.1  # [s]
MAP_PERIOD = 0.5  # [s]
CELL = 0.25  # [m] of the map
STEPS = np.arange(0.75, RANGE, 0.1)  # [m] along a ray


class PlanarRover:
    """The measured planar model on a map of cells, without a camera."""

    def __init__(
        self, navigable: NDArray[np.bool_], start: Pose, samples: list[tuple[float, float]]
    ) -> None:
        self._navigable = navigable
        self._truth = np.kron(navigable, np.ones((4, 4), bool))
        self.pose = start
        self.speed = 0.0
        self.samples = list(samples)
        self.time = 1.0
        self.run = FIRST_RUN
        self.unsafe_pickups = 0
        self._pickup_until = 0.0
        self._map_due = self.time
        self._map_stamp = -1
        self._cells = GridGeometry.of_world(CELL)
        self._known = np.zeros((self._cells.rows, self._cells.cols), bool)

    @property
    def picking_up(self) -> bool:
        return self.time < self._pickup_until

    def frame(self) -> Frame:
        """What ideal sensors would say."""
        stamp = nanoseconds(self.time)
        if self.time >= self._map_due:
            self._map_due, self._map_stamp = self.time + MAP_PERIOD, stamp
        vehicle = VehicleState(
            stamp,
            self.pose,
            speed=0.0 if self.picking_up else self.speed,
            near_sample=self._sample_in_reach() is not None,
            picking_up=self.picking_up,
            sample_count=len(self.samples),
            run=self.run,
        )
        rocks = tuple(
            rock(x, y, number)
            for number, (x, y) in enumerate(self.samples)
            if self._distance(x, y) < 8.0
        )
        return frame_of(vehicle, self._scan(), rocks, self._map_stamp)

    def map(self) -> GridMap:
        """All cells that it has had in view."""
        reach = round(RANGE / CELL)
        row0, col0 = self._cells.cell_of(self.pose.x, self.pose.y)
        steps = np.arange(-reach, reach + 1)
        row, col = np.meshgrid(row0 + steps, col0 + steps, indexing="ij")
        x, y = self._cells.center_of(row, col)
        distance = np.hypot(x - self.pose.x, y - self.pose.y)
        bearing = np.arctan2(y - self.pose.y, x - self.pose.x) - self.pose.yaw
        bearing = (bearing + math.pi) % math.tau - math.pi
        ray = np.clip(np.round(np.degrees(bearing)) + 54, 0, 108).astype(int)
        seen = (np.abs(bearing) < math.radians(54)) & (distance < self._scan().ranges[ray] + 0.5)
        seen &= distance < RANGE
        self._known[row[seen], col[seen]] = True
        cells = np.where(self._known, np.where(self._truth, 0, 100), -1).astype(np.int8)
        return GridMap(CELL, 0.0, 0.0, cells)

    def begin_run(self) -> None:
        """The bridge begins a new run with the next frame; nothing is seen yet."""
        self.run = Run(self.run.number + 1, nanoseconds(self.time))
        self._known[:], self._map_due = False, self.time

    def step(self, command: Command) -> None:
        """One frame of driving."""
        self.time += PERIOD
        if self.time - PERIOD < self._pickup_until <= self.time:
            sample = self._sample_in_reach()
            assert sample is not None
            self.samples.remove(sample)
        if self.picking_up:
            return
        if command.pickup:
            if self._sample_in_reach() is None:
                self.unsafe_pickups += 1
            else:
                self._pickup_until, self.speed = self.time + ROVER.pickup_seconds, 0.0
            return
        self._drive(command)

    def _drive(self, command: Command) -> None:
        limit = ROVER.max_steering
        steering = max(-limit, min(limit, command.steering_angle))
        idle = command.throttle == 0 and command.brake == 0
        if idle and steering and abs(self.speed) < ROVER.turn_in_place_below:
            self._move(0.0, ROVER.turn_in_place_rate * steering * PERIOD)
            self.speed = 0.0
            return
        self.speed += (0.852 * command.throttle - 0.0574 * self.speed) * PERIOD
        brake = min(3.0 * command.brake, 2.5) * PERIOD
        self.speed = math.copysign(max(0.0, abs(self.speed) - brake), self.speed)
        self.speed = max(-2.0, min(5.0, self.speed))
        wheel = steering * (1.0 - 0.667 * min(1.0, abs(self.speed) / 5.0))
        turn = self.speed * math.tan(wheel) / ROVER.wheelbase
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
        angle = self.pose.yaw + BEARINGS[:, None]
        col = np.clip(self.pose.x + STEPS * np.cos(angle), 0, 199).astype(int)
        row = np.clip(self.pose.y + STEPS * np.sin(angle), 0, 199).astype(int)
        blocked = ~self._navigable[row, col]
        return scan_of(np.where(blocked.any(axis=1), STEPS[blocked.argmax(axis=1)], np.inf))

    def _sample_in_reach(self) -> tuple[float, float] | None:
        arm_x = self.pose.x + ROVER.arm_forward * math.cos(self.pose.yaw)
        arm_y = self.pose.y + ROVER.arm_forward * math.sin(self.pose.yaw)
        for x, y in self.samples:
            if math.hypot(x - arm_x, y - arm_y) < ROVER.arm_radius:
                return x, y
        return None

    def _distance(self, x: float, y: float) -> float:
        return math.hypot(x - self.pose.x, y - self.pose.y)


def ring() -> NDArray[np.bool_]:
    """A closed corridor of 6 m around a block."""
    cells = np.zeros((200, 200), bool)
    cells[80:121, 80:121] = True
    cells[86:115, 86:115] = False
    return cells


def bends() -> NDArray[np.bool_]:
    """A winding dead end."""
    cells = np.zeros((200, 200), bool)
    cells[95:102, 80:111] = True
    cells[95:121, 104:111] = True
    cells[114:121, 104:131] = True
    return cells


def rover_in_ring() -> PlanarRover:
    return PlanarRover(ring(), Pose(83.0, 100.0, 1.57), [(83.0, 110.0), (100.0, 118.5)])


def rover_in_bends(kind: type[PlanarRover] = PlanarRover) -> PlanarRover:
    return kind(bends(), Pose(83.0, 98.5, 0.0), [(95.0, 100.5), (125.0, 117.0)])


Watch = Callable[[Frame, Decision], None]


def run_mission(
    rover: PlanarRover,
    config: DecisionConfig,
    time_limit: float,
    watch: Watch = lambda frame, decision: None,
    core: DecisionCore | None = None,
) -> Decision:
    """Until the mission is over or the time [s] is up; the last decision.

    A core that is given takes the place of the one that `config` describes, and is not closed.
    """
    driven = core or make_core(config, lockstep=True)
    try:
        while True:
            frame = rover.frame()
            decision = driven.step(frame)
            watch(frame, decision)
            if decision.state is State.DONE or rover.time > time_limit:
                return decision
            if frame.map_stamp == frame.stamp:
                driven.give_map(frame.stamp, rover.map())
            rover.step(decision.command)
    finally:
        if core is None:
            driven.close()
