"""The localiser and its map in rooms of thin walls."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from maze_world import MazeWorld, box

from rover_common.burger import BURGER
from rover_common.geometry import Pose, distance_between, quaternion_from_pose, wrap_angle
from rover_common.sensor_types import SensorBatch, Twist
from rover_navigation.localization.localizer import Localizer
from rover_navigation.localization.log_odds_map import LogOddsMap
from rover_navigation.localization.scan_map import ScanMap
from rover_navigation.localization.scan_points import ScanPoints

# Not symmetric, so that every pose has scans of its own.
ROOM = np.array([*box(0.0, 0.0, 3.0, 2.2), (1.0, 0.0, 1.0, 0.9), (2.3, 2.2, 2.3, 1.6)])
START = Pose(0.5, 0.6, 0.2)


class Walk:
    """A localiser that is carried through a world."""

    def __init__(self, odometry_at: Pose = START) -> None:
        self.world = MazeWorld(ROOM, START, seed=3, odometry_at=odometry_at)
        self.localizer = Localizer(BURGER, 0.05)
        self.errors: list[float] = []

    def drive(self, seconds: float, twist: Twist, tilt: float = 0.0) -> None:
        for _ in range(round(seconds * 20)):
            batch = self.world.step(twist)
            self.localizer.update(tilted(batch, tilt) if tilt else batch)
            if self.localizer.is_ready:
                self.errors.append(self.error)

    def tour(self) -> None:
        for _ in range(4):
            self.drive(2.5, Twist(0.2, 0.0))
            self.drive(1.3, Twist(0.05, 1.2))

    @property
    def error(self) -> float:
        """[m] of the newest pose."""
        pose = self.localizer.buffer.latest()
        assert pose is not None
        return distance_between(pose, self.world.in_map(self.world.pose))


def tilted(batch: SensorBatch, pitch: float) -> SensorBatch:
    """The robot seems to stand on a slope, where all it sees is the floor before it."""
    turned = quaternion_from_pose(Pose(0.0, 0.0, 0.0, pitch))
    imus = tuple(replace(imu, orientation=turned) for imu in batch.imus)
    scans = tuple(replace(scan, ranges=np.full_like(scan.ranges, 0.3)) for scan in batch.scans)
    return replace(batch, imus=imus, scans=scans)


@pytest.fixture
def walk() -> Walk:
    walk = Walk()
    walk.drive(1.5, Twist())
    return walk


@pytest.mark.parametrize("odometry_at", [START, Pose(1e9, 1e9, -3.0)])
def test_the_pose_stays_true_on_a_tour_wherever_odometry_begins(odometry_at):
    walk = Walk(odometry_at)
    walk.drive(1.5, Twist())
    walk.tour()
    assert np.sqrt(np.mean(np.square(walk.errors))) < 0.02
    assert max(walk.errors) < 0.05
    pose = walk.localizer.buffer.latest()
    assert pose is not None
    assert wrap_angle(pose.yaw - walk.world.in_map(walk.world.pose).yaw) == pytest.approx(
        0, abs=0.02
    )


def test_the_map_shows_the_walls_where_they_are(walk):
    walk.tour()
    cells = walk.localizer.map.cells
    x, y = cells.geometry.center_of(*np.nonzero(cells.walls))
    cos, sin = math.cos(START.yaw), math.sin(START.yaw)
    there = np.stack([START.x + cos * x - sin * y, START.y + sin * x + cos * y], axis=1)
    start, side = ROOM[:, None, :2], (ROOM[:, 2:] - ROOM[:, :2])[:, None]
    along = np.clip(((there - start) * side).sum(2) / np.square(side).sum(2), 0.0, 1.0)
    away = np.hypot(*np.moveaxis(there - start - along[..., None] * side, 2, 0)).min(axis=0)
    assert np.mean(away < 0.075) > 0.97  # the cell's border within 0.05 m
    free = (cells.grid().cells >= 0) & ~cells.walls
    assert np.count_nonzero(free) * 0.05**2 > 0.8 * 3.0 * 2.2
    x, y = cells.geometry.center_of(*np.nonzero(free))
    there_x, there_y = START.x + cos * x - sin * y, START.y + sin * x + cos * y
    outside = np.maximum(np.abs(there_x - 1.5) - 1.5, np.abs(there_y - 1.1) - 1.1)
    assert np.mean(outside > 0.05) < 0.01


def test_a_robot_that_moves_begins_its_first_map_anew():
    walk = Walk()
    walk.drive(0.8, Twist())
    walk.drive(0.5, Twist(0.2, 0.5))
    walk.drive(0.8, Twist())
    assert not walk.localizer.is_ready
    walk.drive(0.6, Twist())
    assert walk.localizer.is_ready
    pose = walk.localizer.buffer.latest()
    assert pose is not None
    assert (pose.x, pose.y, pose.yaw) == pytest.approx((0.0, 0.0, 0.0), abs=0.01)


def test_tilted_scans_are_left_out_and_the_odometry_goes_on(walk):
    known = np.count_nonzero(walk.localizer.map.cells.known)
    walk.drive(1.0, Twist(0.2, 0.0), tilt=math.radians(5.0))
    assert np.count_nonzero(walk.localizer.map.cells.known) == known
    assert not walk.localizer.is_lost
    assert walk.error < 0.02
    walk.drive(1.0, Twist(0.0, 0.0), tilt=math.radians(1.0))
    assert walk.localizer.is_lost  # the same scans, when they count


def test_wheels_that_slip_do_not_move_the_pose(walk):
    walk.drive(1.0, Twist(0.0, -1.2))
    walk.drive(6.0, Twist(0.2, 0.0))  # into a wall
    assert walk.world.contacts > 100
    assert walk.error < 0.06
    assert walk.localizer.relocations == 0


def test_odometry_that_jumps_is_noticed_and_the_pose_found_again(walk):
    walk.tour()
    walk.world.shift_odometry(Pose(-4.0, 7.0, 1.0))
    walk.drive(0.5, Twist())
    assert not walk.localizer.is_lost
    assert walk.localizer.relocations == 1
    assert walk.error < 0.02
    moved = walk.localizer.map_to_odom
    assert moved is not None
    assert abs(moved.x) + abs(moved.y) > 1.0


@pytest.mark.parametrize("there", [Pose(0.9, 1.5, 1.0), Pose(2.5, 0.7, -2.5)])
def test_a_robot_put_elsewhere_finds_its_pose(walk, there):
    walk.tour()
    walk.world.kidnap(there)
    walk.drive(2.0, Twist())
    assert walk.localizer.relocations == 1
    assert walk.error < 0.03


def test_a_scan_waits_for_the_odometry_of_its_last_ray():
    walk = Walk()
    walk.drive(1.5, Twist())
    before = walk.localizer.buffer.correction.newest
    walk.world.odometry_on = False
    walk.drive(0.3, Twist())
    assert walk.localizer.buffer.correction.newest == before
    walk.world.odometry_on = True
    walk.drive(0.1, Twist())
    assert walk.localizer.buffer.correction.newest != before


def test_a_map_grows_in_all_directions_and_keeps_its_cells_in_place():
    cells = LogOddsMap(0.05)
    origin = np.zeros((1, 2))
    cells.integrate(np.array([[0.52, 0.02]]), origin)
    first = cells.grid()
    for end in ([-3.02, 0.02], [0.02, 4.02], [0.02, -2.02]):
        cells.integrate(np.array([end]), origin)
    grown = cells.grid()
    for grid in (first, grown):
        row, col = (round((0.025 - o) / 0.05 - 0.5) for o in (grid.origin_y, grid.origin_x))
        assert grid.cells[row, col + 10] > 50  # the wall
        assert 0 <= grid.cells[row, col + 5] < 50  # the ray
        assert grid.cells[row, col + 11] == -1  # behind
        assert set(np.unique(grid.cells)) <= set(range(-1, 101)) - {50}
    assert grown.cells.shape > first.cells.shape


def test_a_wall_that_is_gone_is_cleared_by_the_rays_that_pass():
    cells = LogOddsMap(0.05)
    near, far, origin = np.array([[0.52, 0.02]]), np.array([[1.02, 0.02]]), np.array([[0.02, 0.02]])
    for _ in range(10):
        cells.integrate(near, origin)
    row, col = (int(i) for i in cells.geometry.cell_of(*near[0]))
    assert cells.walls[row, col]
    for _ in range(10):
        cells.integrate(far, origin)
    assert not cells.walls[row, col]


def test_a_place_is_drawn_once_until_its_scan_is_old():
    room = ScanMap(0.05)
    ends = np.array([[1.0, 0.0], [0.0, 1.0]])
    scan = ScanPoints(0, ends, np.zeros((2, 2)))
    room.add(scan, Pose(0.0, 0.0, 0.0))
    assert not room.lacks(scan, Pose(0.05, 0.0, 2.0))
    assert room.lacks(scan, Pose(0.15, 0.0, 0.0))
    assert room.lacks(replace(scan, stamp=31_000_000_000), Pose(0.05, 0.0, 0.0))
