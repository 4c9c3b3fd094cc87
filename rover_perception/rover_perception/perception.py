"""Perception's core: a camera frame in, a percept out; it keeps the map and the rocks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.dataflow import CameraFrame, GridMap, Percept, PolarArray
from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_perception.classes import Columns, ground_columns, rock_mask
from rover_perception.config import PerceptionConfig
from rover_perception.evidence import EvidenceGrid
from rover_perception.occupancy import occupancy_of
from rover_perception.rock_detection import detect_rocks
from rover_perception.rock_tracks import RockTracks
from rover_perception.scan import free_scan, no_scan
from rover_perception.view import View

RESTART_SECONDS = 5.0  # [s] of time falling back: a new run has begun
JUMP = 20.0  # [m] between two frames: a new run as well, the rover drives 5 m/s


class FrameError(ValueError):
    """A frame that cannot be used; its name is its counter."""

    counter = "frame_invalid"


class ImageSizeError(FrameError):
    counter = "frame_image_size"


class PoseError(FrameError):
    counter = "frame_pose_not_finite"


@dataclass(frozen=True)
class Seen:
    """What was made of the last frame, for the vision image."""

    image: NDArray[np.uint8]
    columns: Columns
    rocks: NDArray[np.uint8]


class Perception:
    """Feed it frames in any order; it needs no ROS."""

    def __init__(self, config: PerceptionConfig) -> None:
        self._config = config
        self.last: Seen | None = None
        self.reset()

    def reset(self) -> None:
        """Forget the map and the rocks."""
        geometry = GridGeometry.of_world(self._config.evidence_resolution)
        self._evidence = EvidenceGrid(geometry, self._config.max_range)
        self._rocks = RockTracks()
        self._poses: list[Pose] = []
        self._stamp: int | None = None
        self._map_stamp: int | None = None

    def process(self, frame: CameraFrame) -> Percept:
        """Add one frame to the map; raises FrameError and leaves the map as it was."""
        _check(frame)
        self._restart_on_new_run(frame)
        map_stamp = self._newest_map(frame.stamp)
        pose = self._pose_of_image(frame.pose)
        view = View.of(ROVER_CAMERA, pose)
        if not view.usable:
            scan = no_scan(self._config.max_range)
            nothing = PolarArray.empty()
            rocks = self._rocks.believed()
            return Percept(frame.stamp, nothing, nothing, scan, rocks, map_stamp)
        mask = rock_mask(frame.image, view)
        sightings = detect_rocks(mask, view, pose)
        columns = ground_columns(frame.image, mask if len(sightings.x) else None, view)
        x, y = self._evidence.add(view, columns, pose)
        if sightings.rocks:
            self._rocks.add(sightings.rocks, frame.stamp)
        self.last = Seen(frame.image, columns, mask)
        return Percept(
            stamp=frame.stamp,
            nav=_polar(x, y),
            rock=_polar(sightings.x, sightings.y),
            scan=free_scan(view, columns, self._config.max_range),
            rocks=self._rocks.believed(),
            map_stamp=map_stamp,
        )

    @property
    def evidence(self) -> EvidenceGrid:
        """What the maps are made of."""
        return self._evidence

    def world_map(self) -> GridMap:
        """The map as it is published."""
        return occupancy_of(self._evidence, self._config.map_resolution)

    def driving_map(self) -> GridMap:
        """The same at the resolution of the evidence."""
        return occupancy_of(self._evidence, self._config.evidence_resolution)

    def _newest_map(self, stamp: int) -> int:
        """Maps are due at the first frame, and at each that is a period away from the last map."""
        last, period = self._map_stamp, self._config.map_period * 1e9
        if last is None or abs(stamp - last) >= period:
            self._map_stamp = last = stamp
        return last

    def _restart_on_new_run(self, frame: CameraFrame) -> None:
        fell_back = self._stamp is not None and frame.stamp < self._stamp - RESTART_SECONDS * 1e9
        jumped = bool(self._poses) and (
            math.hypot(frame.pose.x - self._poses[-1].x, frame.pose.y - self._poses[-1].y) > JUMP
        )
        if fell_back or jumped:
            self.reset()
        self._stamp = frame.stamp

    def _pose_of_image(self, pose: Pose) -> Pose:
        """The pose at which the image was taken: live, it is a frame older than the telemetry."""
        self._poses = [*self._poses, pose][-(self._config.image_lag + 1) :]
        return self._poses[0]


def _check(frame: CameraFrame) -> None:
    expected = (ROVER_CAMERA.height, ROVER_CAMERA.width, 3)
    if frame.image.shape != expected:
        raise ImageSizeError(f"image is {frame.image.shape}, expected {expected}")
    pose = frame.pose
    if not all(map(math.isfinite, (pose.x, pose.y, pose.yaw, pose.pitch, pose.roll))):
        raise PoseError(f"pose is not finite: {pose}")


def _polar(x: NDArray, y: NDArray) -> PolarArray:
    return PolarArray(
        np.hypot(x, y).astype(np.float32),
        np.arctan2(y, x).astype(np.float32),
    )
