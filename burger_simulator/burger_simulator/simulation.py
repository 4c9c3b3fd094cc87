"""The robot in its maze: velocities in, what its sensors say out."""

from __future__ import annotations

from collections import deque

from numpy.random import SeedSequence, default_rng

from burger_simulator.launcher import Launcher
from burger_simulator.model.mjcf import STEP
from burger_simulator.model.physics import Physics
from burger_simulator.options import BurgerOptions
from burger_simulator.sensors.imu import PERIOD as IMU_PERIOD
from burger_simulator.sensors.imu import InertialUnit
from burger_simulator.sensors.lidar import PART, Lidar
from burger_simulator.sensors.odometry import RATE, Odometer, wheel_speeds
from burger_simulator.sensors.thermal import SAMPLE, ThermalSensor
from burger_simulator.truth import Truth, TruthKeeper
from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose
from rover_common.sensor_types import (
    Imu,
    LaserScan,
    SensorBatch,
    ThermalFrame,
    Twist,
    WheelOdometry,
)

SECOND = 1_000_000_000  # [ns]
STEP_NS = round(STEP * SECOND)
TICK = 0.05  # [s] of a call of `step`: the control period
TICK_STEPS = round(TICK / STEP)
START = SECOND  # [ns] a ROS clock that reads zero counts as not yet set
TWIST_HELD = SECOND // 2  # [ns] after which a velocity that is not renewed becomes zero
STEPS_PER_SECOND = round(1.0 / STEP)
PART_STEPS = round(PART / STEP)
IMU_STEPS = round(IMU_PERIOD / STEP)
LOOK_STEPS = round(SAMPLE / STEP)
DEFAULTS = BurgerOptions()


class BurgerSimulation:
    """Advances tick by tick; the same maze, seed, options and velocities give the same batches."""

    def __init__(
        self, maze: Maze, seed: int = 0, options: BurgerOptions = DEFAULTS, began: int = START
    ) -> None:
        """`seed`: of the sensors' noise; what is constant in a robot is drawn with the maze.

        `began`: the stamp [ns] to begin at.
        """
        self.maze = maze
        self._began = began
        self._options = options
        self._physics = Physics(maze, options.box_body)
        lidar, imu, *thermal = (default_rng(child) for child in SeedSequence(seed).spawn(4))
        self._lidar = Lidar(self._physics, options.scan_rate, lidar)
        self._imu = InertialUnit(self._physics, maze.errors, imu)
        self._odometer = Odometer(self._physics, self._imu, began, options.odometry_x)
        settings = zip(
            (options.thermal_yaw_1, options.thermal_yaw_2),
            (options.thermal_offset_1, options.thermal_offset_2),
            maze.errors.thermal_offsets,
            (options.thermal_flip_1, options.thermal_flip_2),
            thermal,
            strict=True,
        )
        slow = options.thermal_rate < 5.0
        self._thermal = [
            ThermalSensor(self._physics, maze, yaw, extra + drawn, flip, slow, random)
            for yaw, extra, drawn, flip, random in settings
        ]
        self._launcher = Launcher()
        self._truth = TruthKeeper(self._physics, maze.ramp)
        self._steps = 0
        self._twist_until = began
        self._on_the_way: deque[ThermalFrame] = deque()  # frames that have not arrived

    @property
    def stamp(self) -> int:
        """[ns]"""
        return self._began + self._steps * STEP_NS

    @property
    def time(self) -> float:
        """[s]"""
        return self.stamp / SECOND

    @property
    def truth(self) -> Truth:
        """For scoring only."""
        return self._truth.at(self.time)

    def place(self, pose: Pose) -> bool:
        """Put the robot on level ground in the maze, standing; False where that is not free."""
        inside = 0.0 < pose.x < self.maze.width and 0.0 < pose.y < self.maze.height
        if not (inside and self._physics.place(pose)):
            return False
        self._twist_until = self.stamp
        self._truth.moved()
        return True

    def step(self, twist: Twist | None = None, launch: bool = False) -> SensorBatch:
        """One tick.

        twist: a new velocity, None where none came; `launch`: the launcher is signalled now.
        """
        if twist is not None:
            self._twist_until = self.stamp + TWIST_HELD
            self._physics.drive(*wheel_speeds(twist))
        if launch and self._launcher.signal(self.stamp):
            self._truth.launched(self.time)
        scans: list[LaserScan] = []
        imus: list[Imu] = []
        odometry: list[WheelOdometry] = []
        for _ in range(TICK_STEPS):
            self._advance()
            if self._steps % PART_STEPS == PART_STEPS // 2:
                scan = self._lidar.measure_part(self.stamp)
                scans += [] if scan is None else [scan]
            if self._steps % IMU_STEPS == 0:
                imus.append(self._imu.measure(self.stamp))
            if self._steps * RATE % STEPS_PER_SECOND < RATE:
                odometry.append(self._odometer.measure(self.stamp))
            if self._steps % LOOK_STEPS == 0:
                self._look()
        self._truth.measure_distance()
        return SensorBatch(
            stamp=self.stamp,
            scans=tuple(scans),
            imus=tuple(imus),
            odometry=tuple(odometry),
            thermal=tuple(self._arrived()),
            launches_done=self._launcher.reports(self.stamp),
        )

    def _advance(self) -> None:
        if self.stamp >= self._twist_until:
            self._physics.drive(0.0, 0.0)
        self._physics.advance()
        self._steps += 1
        self._truth.follow(STEP)

    def _look(self) -> None:
        due = self._steps % round(1.0 / (self._options.thermal_rate * STEP)) == 0
        arrives = self.stamp + round(self._options.thermal_delay * SECOND)
        for number, sensor in enumerate(self._thermal, 1):
            if number != self._options.thermal_dead:
                sensor.look()
                if due:
                    self._on_the_way.append(ThermalFrame(arrives, number, sensor.frame()))

    def _arrived(self) -> list[ThermalFrame]:
        frames = []
        while self._on_the_way and self._on_the_way[0].stamp <= self.stamp:
            frames.append(self._on_the_way.popleft())
        return frames
