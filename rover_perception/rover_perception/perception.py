"""The perception pipeline: a camera frame in, a perception result out.

It keeps the map and the rock tracks of the run, and needs no ROS.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.grid import WORLD, GridGeometry
from rover_common.saved_state import Memory
from rover_common.types import (
    FIRST_RUN,
    CameraFrame,
    FreeScan,
    GridMap,
    PerceptionResult,
    PolarArray,
    Run,
)
from rover_perception.camera.birdseye import birdseye_image
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import Segmentation, ground_columns, rock_mask
from rover_perception.camera.vision import vision_image
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameValidator
from rover_perception.map_schedule import MapSchedule
from rover_perception.mapping.evidence import EvidenceGrid
from rover_perception.mapping.field_of_view import FieldOfView
from rover_perception.mapping.free_scan import blocked_scan, free_scan
from rover_perception.mapping.occupancy import OccupancyMaps
from rover_perception.polar import polar_array
from rover_perception.stages import StageRunner, run_stage
from rover_perception.tracking.rock_detection import detect_rocks
from rover_perception.tracking.rock_tracks import RockTracks


class Perception:
    """Processes the frames of one run after another, in the order of their stamps."""

    def __init__(self, config: PerceptionConfig, run_stage: StageRunner = run_stage) -> None:
        """`run_stage` calls every stage of `process`; a benchmark passes one that also measures."""
        self._config = config
        self._run_stage = run_stage
        geometry = GridGeometry.of_world(config.evidence_resolution)
        self._field_of_view = FieldOfView(geometry, config.max_range)
        self._begin(FIRST_RUN, EvidenceGrid(self._field_of_view), RockTracks())

    def _begin(self, run: Run, evidence: EvidenceGrid, rocks: RockTracks) -> None:
        """Start with this map and these rock tracks, and no history of frames."""
        config = self._config
        self._run = run
        self._validator = FrameValidator(ROVER_CAMERA, WORLD.size, config.image_lag)
        self._evidence = evidence
        self._maps = OccupancyMaps(evidence, config.map_resolution)
        self._rocks = rocks
        self._schedule = MapSchedule(config.map_period)
        self._segmentation: Segmentation | None = None

    def process(self, frame: CameraFrame) -> PerceptionResult:
        """Add one frame to the map and the rock tracks.

        A frame of another run starts anew first. Raises FrameError for a frame that cannot be used,
        which leaves map and tracks unchanged.
        """
        if frame.run.number != self._run.number:
            self._begin(frame.run, EvidenceGrid(self._field_of_view), RockTracks())
        run, image, max_range = self._run_stage, frame.image, self._config.max_range
        pose = run("validation", self._validator.validate, frame)
        projection = run("projection", GroundProjection.of, ROVER_CAMERA, pose)
        if not projection.usable:
            self._segmentation = None
            return self._result(frame, blocked_scan(max_range))
        mask = run("rock_mask", rock_mask, image, projection)
        rocks = run("rock_detection", detect_rocks, image, mask, projection, pose)
        ground_mask = mask if len(rocks.x) else None
        columns = run("ground_columns", ground_columns, image, ground_mask, projection)
        ground = run("evidence", self._evidence.add, projection, columns, pose)
        run("rock_tracks", self._rocks.add, rocks.rocks, frame.stamp)
        scan = run("free_scan", free_scan, projection, columns, max_range)
        nav = run("nav_polar", polar_array, *ground)
        rock = run("rock_polar", polar_array, rocks.x, rocks.y)
        self._segmentation = Segmentation(image, mask, columns, projection)
        return self._result(frame, scan, nav, rock)

    def memory(self) -> Callable[[], Memory]:
        """A copy of map and rocks; the call makes of it what `resume` takes."""
        rocks, arrays = self._rocks.memory(), self._evidence.memory()
        return lambda: ({"rocks": rocks}, arrays())

    def resume(self, run: Run, memory: Memory) -> None:
        """Go on with a run as it was saved.

        Raises ValueError, TypeError or KeyError for what is none, and changes nothing then.
        """
        values, arrays = memory
        evidence, rocks = EvidenceGrid(self._field_of_view), RockTracks()
        evidence.restore(arrays)
        rocks.restore(values["rocks"])
        self._begin(run, evidence, rocks)

    @property
    def segmentation(self) -> Segmentation | None:
        """Of the newest frame; None before the first one of a run, and without usable ground."""
        return self._segmentation

    def vision_image(self) -> NDArray[np.uint8] | None:
        """The newest image (height, width, 3) RGB with what its pixels show; None without one."""
        return None if self._segmentation is None else vision_image(self._segmentation)

    def birdseye_image(self) -> NDArray[np.uint8] | None:
        """What the newest image shows from above; None without one."""
        if self._segmentation is None:
            return None
        return birdseye_image(self._segmentation, self._config.max_range)

    @property
    def evidence(self) -> EvidenceGrid:
        """What the maps are derived from."""
        return self._evidence

    def world_map(self) -> GridMap:
        """The map in cells of `map_resolution`."""
        return self._maps.world_map()

    def navigation_map(self) -> GridMap:
        """The same map in cells of `evidence_resolution`."""
        return self._maps.navigation_map()

    def _result(
        self,
        frame: CameraFrame,
        scan: FreeScan,
        nav: PolarArray | None = None,
        rock: PolarArray | None = None,
    ) -> PerceptionResult:
        return PerceptionResult(
            stamp=frame.stamp,
            nav=nav or PolarArray.empty(),
            rock=rock or PolarArray.empty(),
            scan=scan,
            rocks=self._rocks.confirmed(),
            map_stamp=self._schedule.newest(frame.stamp),
            run=frame.run,
        )
