"""Localisation and mapping from wheel odometry, laser scans and the tilt, one batch at a time."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rover_common.burger import BurgerModel
from rover_common.geometry import Pose, compose, distance_between, inverse, wrap_angle
from rover_common.sensor_types import LaserScan, SensorBatch, WheelOdometry
from rover_navigation.localization.dead_reckoning import DeadReckoning
from rover_navigation.localization.distance_field import DistanceField
from rover_navigation.localization.log_odds_map import LogOddsMap
from rover_navigation.localization.pose_buffer import PoseBuffer
from rover_navigation.localization.relocation import (
    all_candidates,
    best_candidate,
    near_candidates,
)
from rover_navigation.localization.scan_matching import Match, match
from rover_navigation.localization.scan_points import ScanPoints, deskew, last_ray
from rover_navigation.localization.tilt_meter import TiltMeter

STANDING = 1_000_000_000  # [ns] a map that begins in a turn stays turned by up to 6 degrees
STILL_DISTANCE, STILL_TURN = 0.01, 0.01  # [m], [rad] of odometry while standing
TILT_LIMIT = math.radians(2.5)  # beyond, the scan shows the floor or misses walls
# [m] between scans that the map takes, of all that it took: a lidar that sees all around shows
# nothing new where it was before, and a map that is drawn again and again follows the pose's error.
KEYFRAME_DISTANCE = 0.1
CHANGED = 0.9  # share of inliers below which the world has changed: it takes them anywhere
INLIER = 0.1  # [m] from a wall of the map
TRACKED, RELOCATED = 0.5, 0.75  # shares of inliers at which a pose is accepted
BAD_SCANS = 5  # in a row, after which the pose is searched
# Error of the odometry between two scans: [m], [m/m], [rad], [rad/rad]. Its heading is the gyro's.
DRIFT, DRIFT_PER_DISTANCE, TURN_DRIFT, TURN_DRIFT_PER_TURN = 0.001, 0.03, 0.0005, 0.005
SEARCHED = np.diag([0.05**2, 0.05**2, 0.05**2])  # covariance of a candidate


class Localizer:
    """The pose in a map that it makes itself. The map frame is where the robot stood at first.

    The buffer's odom frame is that of the dead reckoning, which is not the odometry's own.
    """

    def __init__(self, model: BurgerModel, resolution: float) -> None:
        self.buffer = PoseBuffer()
        self.map = LogOddsMap(resolution)
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
        self._field: DistanceField | None = None
        self._keyframes = np.zeros((1, 2))  # (n, 2) [m] where the map took scans
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
            self.map = LogOddsMap(self.map.geometry.resolution)
            self.buffer.correction.add(points.stamp, inverse(odometry))
        self.map.integrate(*points.placed(Pose(0.0, 0.0, 0.0)))
        standing = points.stamp - rest[0]
        if standing >= STANDING and self.map.walls.any():
            self._reckoning.stood(wrap_angle(odometry.yaw - rest[1].yaw), standing / 1e9)
            self._tilt.set_level(rest[0], points.stamp)
            self._renew_field()
            self._matched = odometry
            self.is_ready = True

    def _place(self, points: ScanPoints, odometry: Pose) -> None:
        """Find where a scan was taken; the map takes it when it is a keyframe."""
        assert self._field is not None
        correction = self.buffer.correction.at(points.stamp)
        predicted = compose(correction, odometry)
        prior = self.covariance + _drift(self._matched, odometry)
        if not self.is_lost:
            found = match(points.ends, self._field, predicted, prior)
            if self._accept(points, odometry, found, TRACKED):
                return
            self._bad_scans += 1
        if self.is_lost or self._bad_scans >= BAD_SCANS:
            self._search(points, odometry, predicted)

    def _search(self, points: ScanPoints, odometry: Pose, expected: Pose) -> None:
        """Try poses nearby, then all."""
        assert self._field is not None
        self.is_lost = True
        free = self.map.known & ~self.map.walls
        for places, yaws in (
            near_candidates(expected),
            all_candidates(self._field, free, expected),
        ):
            start = best_candidate(points.ends, self._field, expected, places, yaws)
            found = match(points.ends, self._field, start, SEARCHED)
            if self._accept(points, odometry, found, RELOCATED):
                self.is_lost = False
                self.relocations += 1
                return

    def _accept(self, points: ScanPoints, odometry: Pose, found: Match, least: float) -> bool:
        """Take the pose if at least such a share of the points are inliers there."""
        agreement = self._agreement(points, found.pose)
        if agreement < least:
            return False
        self._bad_scans = 0
        self._matched, self.covariance = odometry, found.covariance
        self.buffer.correction.add(points.stamp, compose(found.pose, inverse(odometry)))
        here = np.array([[found.pose.x, found.pose.y]])
        elsewhere = np.hypot(*(self._keyframes - here).T).min() >= KEYFRAME_DISTANCE
        if elsewhere or agreement < CHANGED:
            self._keyframes = np.concatenate([self._keyframes, here])
            self.map.integrate(*points.placed(found.pose))
            self._renew_field()
        return True

    def _renew_field(self) -> None:
        self._field = DistanceField.of(self.map.geometry, self.map.walls)

    def _agreement(self, points: ScanPoints, pose: Pose) -> float:
        """Share of the points that lie at walls of the map; those beyond its known cells say
        nothing."""
        assert self._field is not None
        ends, _ = points.placed(pose)
        row, col = self.map.geometry.cell_of(ends[:, 0], ends[:, 1])
        inside = self.map.geometry.contains(row, col)
        inside[inside] = self.map.known[row[inside], col[inside]]
        if not inside.any():
            return 0.0
        return float((self._field.at(*ends[inside].T) < INLIER).mean())


def _moved(a: Pose, b: Pose, distance: float, turn: float) -> bool:
    return distance_between(a, b) >= distance or abs(wrap_angle(a.yaw - b.yaw)) >= turn


def _drift(before: Pose, now: Pose) -> NDArray[np.float64]:
    """Covariance (3, 3) of the odometry between two of its poses."""
    along = DRIFT + DRIFT_PER_DISTANCE * distance_between(before, now)
    turn = TURN_DRIFT + TURN_DRIFT_PER_TURN * abs(wrap_angle(before.yaw - now.yaw))
    return np.diag(np.square([along, along, turn]))
