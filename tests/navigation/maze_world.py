"""A burger in a maze of thin walls, on a plane: exact rays, wheels with errors, contacts.

It is only as true as the tests of the navigator need it; it knows no slip and no ramp.
"""

from __future__ import annotations

import math

import numpy as np

from rover_common.burger import BURGER
from rover_common.geometry import Pose, compose, inverse
from rover_common.sensor_types import Imu, LaserScan, SensorBatch, Twist, WheelOdometry

TICK = 0.01  # [s] of the motion
BATCH = 5  # ticks between two batches: 20 Hz
SCAN, RAYS = 10, 230  # ticks of a turn of the lidar, and rays in it
RESPONSE = 0.08  # [s] in which the wheels follow
WIDTH, DEPTH = 3.70, 3.28  # [m] of the field
COLS, ROWS = 6, 5  # cells of the maze in it


def box(x0: float, y0: float, x1: float, y1: float) -> list[tuple[float, float, float, float]]:
    """The four walls of a rectangle [m]."""
    return [(x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)]


def maze(seed: int, opened: float = 0.25) -> np.ndarray:
    """Walls (n, 4) [m]: a spanning tree of passages, and a share of the other walls taken out."""
    generator = np.random.default_rng(seed)
    cell_x, cell_y = WIDTH / COLS, DEPTH / ROWS
    between = [((r, c), (r, c + 1)) for r in range(ROWS) for c in range(COLS - 1)]
    between += [((r, c), (r + 1, c)) for r in range(ROWS - 1) for c in range(COLS)]
    group = {(r, c): (r, c) for r in range(ROWS) for c in range(COLS)}

    def root(cell: tuple[int, int]) -> tuple[int, int]:
        while group[cell] != cell:
            cell = group[cell]
        return cell

    walls = box(0.0, 0.0, WIDTH, DEPTH)
    for index in generator.permutation(len(between)).tolist():
        (row, col), other = between[index]
        first, second = root((row, col)), root(other)
        if first != second:
            group[first] = second
        elif generator.random() > opened:
            x, y = (col + 1) * cell_x, (row + 1) * cell_y
            wall = (x, y - cell_y, x, y) if other[0] == row else (x - cell_x, y, x, y)
            walls.append(wall)
    return np.array(walls)


def cell_center(row: int, col: int) -> tuple[float, float]:
    """[m]"""
    return (col + 0.5) * WIDTH / COLS, (row + 0.5) * DEPTH / ROWS


class MazeWorld:
    """`step(twist)` moves the robot for one batch and gives what its sensors say.

    `pose` is the truth, `odometry` what the wheels say, `contacts` the ticks at which the
    body's disc touched a wall.
    """

    def __init__(self, walls: np.ndarray, start: Pose, seed: int, odometry_at: Pose) -> None:
        """odometry_at: what the odometry says at the start."""
        self.walls = walls
        self.pose = self.start = start
        self.contacts = 0
        self.clearance = math.inf  # [m] least, of the axle's middle
        self.scans_on = True
        self.odometry_on = True
        self._generator = np.random.default_rng(seed)
        self.odometry = odometry_at
        self._twist = self._told = Twist()
        self._ticks = 0
        self._rays: list[np.ndarray] = []
        self._tape = 1.0 + self._generator.normal(0.0, 0.005)  # error of the wheels' radius
        self._bias = self._generator.normal(0.0, 0.002)  # [rad/s] of the gyro

    @property
    def stamp(self) -> int:
        """[ns]"""
        return round(self._ticks * TICK * 1e9)

    def in_map(self, pose: Pose) -> Pose:
        """A true pose in the map frame, which is the start."""
        return compose(inverse(self.start), pose)

    def kidnap(self, pose: Pose) -> None:
        """Put the robot elsewhere, which the odometry does not notice."""
        self.pose = pose

    def shift_odometry(self, pose: Pose) -> None:
        """Begin the odometry anew."""
        self.odometry = pose

    def step(self, twist: Twist) -> SensorBatch:
        """Drive for one batch."""
        self._told = twist
        scans, imus, odometry = [], [], []
        for _ in range(BATCH):
            self._move()
            imus.append(
                Imu(
                    self.stamp,
                    (0.0, 0.0, 0.0, 1.0),
                    (0.0, 0.0, self._twist.angular),
                    (0.0, 0.0, 9.8),
                )
            )
            scan = self._turn_lidar()
            if scan is not None and self.scans_on:
                scans.append(scan)
        if self.odometry_on:
            odometry.append(WheelOdometry(self.stamp, self.odometry, self._twist))
        return SensorBatch(self.stamp, tuple(scans), tuple(imus), tuple(odometry))

    def _move(self) -> None:
        self._ticks += 1
        share = TICK / RESPONSE
        linear = self._twist.linear + share * (self._told.linear - self._twist.linear)
        angular = self._twist.angular + share * (self._told.angular - self._twist.angular)
        self._twist = Twist(linear, angular)
        moved = Pose(linear * TICK, 0.0, angular * TICK)
        wrong = Pose(linear * TICK * self._tape, 0.0, (angular + self._bias) * TICK)
        there = compose(self.pose, moved)
        distance = distance_to_walls(self.walls, there)
        if distance < BURGER.body_radius:
            self.contacts += 1
            moved = Pose(0.0, 0.0, moved.yaw)  # the wheels turn on
        self.clearance = min(self.clearance, distance)
        self.pose = compose(self.pose, moved)
        self.odometry = compose(self.odometry, wrong)

    def _turn_lidar(self) -> LaserScan | None:
        """The rays of this tick; the whole turn at its end."""
        part = RAYS // SCAN
        done = len(self._rays) * part
        angles = np.arange(done, done + part) * (2 * math.pi / RAYS) + self.pose.yaw
        x = self.pose.x + BURGER.lidar_x * math.cos(self.pose.yaw)
        y = self.pose.y + BURGER.lidar_x * math.sin(self.pose.yaw)
        exact = cast(self.walls, x, y, angles)
        noisy = exact + self._generator.normal(0.0, 1.0, part) * (0.005 + 0.01 * exact)
        lost = self._generator.random(part) < 0.01
        self._rays.append(np.where(lost | (exact > BURGER.lidar_range_max), np.inf, noisy))
        if len(self._rays) < SCAN:
            return None
        ranges = np.concatenate(self._rays).astype(np.float32)
        self._rays = []
        first = self.stamp - round((SCAN - 1) * TICK * 1e9)
        return LaserScan(
            first, 0.0, 2 * math.pi / RAYS, SCAN * TICK / RAYS,
            BURGER.lidar_range_min, BURGER.lidar_range_max, ranges,
        )  # fmt: skip


def cast(walls: np.ndarray, x: float, y: float, angles: np.ndarray) -> np.ndarray:
    """[m] from a point along each angle (n,) [rad] to the first wall; inf where there is none."""
    direction = np.stack([np.cos(angles), np.sin(angles)])[:, :, None]  # (2, n, 1)
    start = walls[:, :2].T[:, None] - np.array([[[x]], [[y]]])  # (2, 1, walls)
    side = (walls[:, 2:] - walls[:, :2]).T[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        across = direction[0] * side[1] - direction[1] * side[0]
        away = (start[0] * side[1] - start[1] * side[0]) / across
        along = (start[0] * direction[1] - start[1] * direction[0]) / across
    hits = (away > 0.0) & (along >= -1e-9) & (along <= 1.0 + 1e-9)
    return np.where(hits, away, np.inf).min(axis=1)


def distance_to_walls(walls: np.ndarray, pose: Pose) -> float:
    """[m] from the pose's place to the nearest wall."""
    start, side = walls[:, :2], walls[:, 2:] - walls[:, :2]
    to = np.array([pose.x, pose.y]) - start
    share = np.clip((to * side).sum(axis=1) / np.square(side).sum(axis=1), 0.0, 1.0)
    return float(np.hypot(*(to - share[:, None] * side).T).min())
