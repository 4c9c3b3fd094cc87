"""Localisation and mapping from wheel odometry, laser scans and the tilt, one batch at a time."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BurgerModel
from rover_common.geometry import Pose, compose, distance_between, inverse, wrap_angle
from rover_common.saved_state import Memory, joined, part_of
from rover_common.sensor_types import LaserScan, SensorBatch, WheelOdometry
from rover_navigation.localization.dead_reckoning import DeadReckoning
from rover_navigation.localization.pose_buffer import PoseBuffer
from rover_navigation.localization.scan_map import ScanMap
from rover_navigation.localization.scan_matching import Match
from rover_navigation.localization.scan_points import ScanPoints, deskew, last_ray
from rover_navigation.localization.tilt_meter import TiltMeter

STANDING = 1_000_000_000  # [ns] a map that begins in a turn stays turned by up to 6 degrees
STILL_DISTANCE, STILL_TURN = 0.01, 0.01  # [m], [rad] of odometry while standing
TILT_LIMIT = math.radians(2.5)  # beyond, the scan shows the floor or misses walls
ACCEPTED = 0.8  # share of a scan at walls, at which a pose is
BAD_SCANS = 5  # in a row, after which the pose is searched
# Error of the odometry between two scans: [m], [m/m], [rad], [rad/rad]. Its heading is the gyro's.
DRIFT, DRIFT_PER_DISTANCE, TURN_DRIFT, TURN_DRIFT_PER_TURN = 0.005, 0.1, 0.002, 0.02


class Localizer:
    """The pose in a map that it makes itself. The map frame is where the robot stood at first.

    The buffer's odom frame is that of the dead reckoning, which is not the odometry's own.
    """

    def __init__(self, model: BurgerModel, resolution: float) -> None:
        self.buffer = PoseBuffer()
        self._resolution = resolution
        self.map = ScanMap(resolution)
        self.covariance = np.zeros((3, 3))  # x, y [m], yaw [rad]
        self.is_ready = False  # has stood still and has a map
        self.is_lost = False  # searches its pose
        self.relocations = 0  # times that a pose was found by search
        self._model = model
        self._tilt = TiltMeter()
        self._reckoning = DeadReckoning(self.buffer.odometry)
        self._waiting: LaserScan | None = None
        self._points = ScanPoints(0, np.empty((0, 2)), np.empty((0, 2)))  # of the last scan
        self._rest: tuple[int, Pose] | None = None  # since when and where it stands
        self._matched = Pose(0.0, 0.0, 0.0)  # odometry of the last scan that was matched
        self._bad_scans = 0

    @property
    def map_to_odom(self) -> Pose | None:
        """The odom frame in the map."""
        pose = self.buffer.latest()
        return None if pose is None else self._reckoning.odom_in(pose)

    @property
    def newest_odometry(self) -> WheelOdometry | None:
        """The last message."""
        return self._reckoning.newest

    def memory(self) -> Callable[[], Memory]:
        """A copy, once it is ready; what is called makes a memory of it.

        Without the scan that waits for its odometry, and the last one for its free side.
        """
        matched, made = self._matched, self.map.memory()
        values = {
            "is_lost": self.is_lost,
            "relocations": self.relocations,
            "bad_scans": self._bad_scans,
            "matched": [matched.x, matched.y, matched.yaw],
            "covariance": self.covariance.tolist(),
        }
        parts = {
            "pose": (values, {}),
            "reckoning": (self._reckoning.memory(), {}),
            "buffer": self.buffer.memory(),
            "tilt": self._tilt.memory(),
        }
        return lambda: joined(map=made(), **parts)

    def restore(self, memory: Memory) -> None:
        """Go on with the map and the pose whose memory it is, instead of standing for a first map.

        Raises ValueError, TypeError or KeyError for anything else, and is not to be used then.
        """
        values, _ = part_of(memory, "pose")
        self.map.restore(part_of(memory, "map"))
        self._reckoning.restore(part_of(memory, "reckoning")[0])
        self.buffer.restore(part_of(memory, "buffer"))
        self._tilt.restore(part_of(memory, "tilt"))
        x, y, yaw = values["matched"]
        self._matched = Pose(float(x), float(y), float(yaw))
        self.covariance = np.array(values["covariance"], float).reshape(3, 3)
        self.is_lost, self._bad_scans = bool(values["is_lost"]), int(values["bad_scans"])
        self.relocations = int(values["relocations"])
        if self.buffer.latest() is None or not self.map.has_walls:
            raise ValueError("no map, or no pose in it")
        self.is_ready = True

    def free_side(self) -> int:
        """+1 where the last scan shows more free ground to the left, else -1."""
        left = self._points.ends[:, 1] > 0.0
        away = np.hypot(*self._points.ends.T)
        return 1 if away[left].sum() >= away[~left].sum() else -1

    def update(self, batch: SensorBatch) -> None:
        """Take a batch. A scan waits until the odometry covers its last ray, or for a newer one."""
        for imu in batch.imus:
            self._tilt.add(imu)
        jumps = self._reckoning.jumps
        for odometry in batch.odometry:
            self._reckoning.add(odometry)
        self.is_lost |= self.is_ready and self._reckoning.jumps > jumps
        waiting = () if self._waiting is None else (self._waiting,)
        for scan in (*waiting, *batch.scans):
            self._waiting = scan
            newest = self.buffer.odometry.newest
            if newest is not None and newest[0] >= last_ray(scan):
                self._waiting = None
                self._add_scan(scan)

    def _add_scan(self, scan: LaserScan) -> None:
        self._points = points = deskew(scan, self.buffer.odometry, self._model.lidar_x)
        odometry = self.buffer.odometry.at(points.stamp)
        if not self.is_ready:
            self._stand(points, odometry)
        elif self._tilt.tilt(scan.stamp, points.stamp) < TILT_LIMIT and len(points.ends):
            self._place(points, odometry)

    def _stand(self, points: ScanPoints, odometry: Pose) -> None:
        """Scans taken standing still make the first map; a robot that moves begins anew."""
        rest = self._rest
        if rest is None or _moved(rest[1], odometry, STILL_DISTANCE, STILL_TURN):
            self._rest = rest = (points.stamp, odometry)
            self.map = ScanMap(self._resolution)
            self.buffer.correction.add(points.stamp, inverse(odometry))
        self.map.add(points, Pose(0.0, 0.0, 0.0))
        standing = points.stamp - rest[0]
        if standing >= STANDING and self.map.has_walls:
            self._reckoning.stood(wrap_angle(odometry.yaw - rest[1].yaw), standing / 1e9)
            self._tilt.set_level(rest[0], points.stamp)
            self._matched = odometry
            self.is_ready = True

    def _place(self, points: ScanPoints, odometry: Pose) -> None:
        """Find where a scan was taken."""
        expected = compose(self.buffer.correction.at(points.stamp), odometry)
        if not self.is_lost:
            prior = self.covariance + _drift(self._matched, odometry)
            found = self.map.match(points, expected, prior)
            if self._accept(points, odometry, found):
                return
            self._bad_scans += 1
            self.is_lost = self._bad_scans >= BAD_SCANS
        if self.is_lost:
            for found in self.map.search(points, expected):
                if self._accept(points, odometry, found):
                    self.is_lost = False
                    self.relocations += 1
                    return

    def _accept(self, points: ScanPoints, odometry: Pose, found: Match) -> bool:
        """Take a pose if the scan lies at walls there."""
        if self.map.agreement(points, found.pose) < ACCEPTED:
            return False
        self._bad_scans = 0
        self._matched, self.covariance = odometry, found.covariance
        self.buffer.correction.add(points.stamp, compose(found.pose, inverse(odometry)))
        if self.map.lacks(points, found.pose):
            self.map.add(points, found.pose)
        return True


def _moved(a: Pose, b: Pose, distance: float, turn: float) -> bool:
    return distance_between(a, b) >= distance or abs(wrap_angle(a.yaw - b.yaw)) >= turn


def _drift(before: Pose, now: Pose) -> NDArray[np.float64]:
    """Covariance (3, 3) of the odometry between two of its poses."""
    along = DRIFT + DRIFT_PER_DISTANCE * distance_between(before, now)
    turn = TURN_DRIFT + TURN_DRIFT_PER_TURN * abs(wrap_angle(before.yaw - now.yaw))
    return np.diag(np.square([along, along, turn]))
