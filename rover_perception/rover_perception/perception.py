"""Perception's core: a camera frame in, a perception result out; it keeps the map and the rocks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.grid import GridGeometry
from rover_common.types import (
    FIRST_RUN,
    CameraFrame,
    GridMap,
    PerceptionResult,
    PolarArray,
    Run,
)
from rover_perception.camera.ground_projection import View
from rover_perception.camera.segmentation import Columns, ground_columns, rock_mask
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameGate
from rover_perception.mapping.evidence import EvidenceGrid
from rover_perception.mapping.occupancy import occupancy_of
from rover_perception.mapping.scan import free_scan, no_scan
from rover_perception.tracking.rock_detection import detect_rocks
from rover_perception.tracking.rock_tracks import RockTracks


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
        self._begin(FIRST_RUN)

    def _begin(self, run: Run) -> None:
        """Forget the map, the rocks and the frames before."""
        self._run = run
        self._gate = FrameGate(self._config.image_lag)
        geometry = GridGeometry.of_world(self._config.evidence_resolution)
        self._evidence = EvidenceGrid(geometry, self._config.max_range)
        self._rocks = RockTracks()
        self._map_stamp: int | None = None

    def process(self, frame: CameraFrame) -> PerceptionResult:
        """Add one frame to the map; raises FrameError and leaves the map as it was."""
        if frame.run.number != self._run.number:
            self._begin(frame.run)
        pose = self._gate.admit(frame)
        map_stamp = self._newest_map(frame.stamp)
        view = View.of(ROVER_CAMERA, pose)
        if not view.usable:
            scan = no_scan(self._config.max_range)
            nothing = PolarArray.empty()
            rocks = self._rocks.believed()
            return PerceptionResult(
                frame.stamp, nothing, nothing, scan, rocks, map_stamp, frame.run
            )
        mask = rock_mask(frame.image, view)
        sightings = detect_rocks(frame.image, mask, view, pose)
        columns = ground_columns(frame.image, mask if len(sightings.x) else None, view)
        x, y = self._evidence.add(view, columns, pose)
        if sightings.rocks:
            self._rocks.add(sightings.rocks, frame.stamp)
        self.last = Seen(frame.image, columns, mask)
        return PerceptionResult(
            stamp=frame.stamp,
            nav=_polar(x, y),
            rock=_polar(sightings.x, sightings.y),
            scan=free_scan(view, columns, self._config.max_range),
            rocks=self._rocks.believed(),
            map_stamp=map_stamp,
            run=frame.run,
        )

    @property
    def evidence(self) -> EvidenceGrid:
        """What the maps are made of."""
        return self._evidence

    def world_map(self) -> GridMap:
        """The map as it is published."""
        return occupancy_of(self._evidence, self._config.map_resolution)

    def navigation_map(self) -> GridMap:
        """The same at the resolution of the evidence."""
        return occupancy_of(self._evidence, self._config.evidence_resolution)

    def _newest_map(self, stamp: int) -> int:
        """Maps are due at the first frame, and at each that is a period away from the last map."""
        last, period = self._map_stamp, self._config.map_period * 1e9
        if last is None or abs(stamp - last) >= period:
            self._map_stamp = last = stamp
        return last


def _polar(x: NDArray, y: NDArray) -> PolarArray:
    return PolarArray(
        np.hypot(x, y).astype(np.float32),
        np.arctan2(y, x).astype(np.float32),
    )
