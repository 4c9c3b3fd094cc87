"""The baseline's pipeline: warp to a top view, thresholds, and counts per cell of the map.

It takes and gives what the exact pipeline does. The map follows the community's rule: a cell that
was seen as ground once is navigable, whatever was seen there since.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.grid import WORLD, GridGeometry
from rover_common.map_encoding import UNKNOWN
from rover_common.saved_state import Memory
from rover_common.types import FIRST_RUN, CameraFrame, GridMap, PerceptionResult, Run
from rover_perception.baseline.rock_list import RockList
from rover_perception.baseline.thresholds import ground_mask, rock_mask
from rover_perception.baseline.top_view import FIRST_ROW, field_of_view, rover_points, top_view
from rover_perception.baseline.view_scan import nearest_obstacles
from rover_perception.camera.birdseye import colored
from rover_perception.camera.vision import paint
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameValidator
from rover_perception.map_schedule import MapSchedule
from rover_perception.mapping.free_scan import scan_of
from rover_perception.polar import polar_array

IMAGE_LAG = 0  # these programs take an image for one of the pose that it comes with
GROUND, OBSTACLE, ROCK = range(3)  # layers of the counts
Points = tuple[NDArray[np.float64], NDArray[np.float64]]  # x, y [m]


class BaselinePerception:
    """Processes the frames of one run after another, in the order of their stamps."""

    def __init__(self, config: PerceptionConfig) -> None:
        self._config = config
        self._geometry = GridGeometry.of_world(config.map_resolution)
        self._begin(FIRST_RUN, self._no_counts(), RockList())

    def _begin(self, run: Run, counts: NDArray[np.int32], rocks: RockList) -> None:
        self._run = run
        self._validator = FrameValidator(ROVER_CAMERA, WORLD.size, IMAGE_LAG)
        self._schedule = MapSchedule(self._config.map_period)
        self._rocks = rocks
        self._image: NDArray[np.uint8] | None = None
        # (rows, cols, 3): in how many frames each cell was ground, obstacle and rock
        self.counts = counts

    def _no_counts(self) -> NDArray[np.int32]:
        return np.zeros((self._geometry.rows, self._geometry.cols, 3), np.int32)

    def memory(self) -> Callable[[], Memory]:
        """A copy of map and rocks; the call makes of it what `resume` takes."""
        rocks, counts = self._rocks.memory(), self.counts.copy()
        return lambda: ({"rocks": rocks}, {"counts": counts})

    def resume(self, run: Run, memory: Memory) -> None:
        """Go on with a run as it was saved.

        Raises ValueError, TypeError or KeyError for what is none, and changes nothing then.
        """
        values, arrays = memory
        counts, rocks = arrays["counts"], RockList()
        if counts.shape != self.counts.shape:
            raise ValueError(f"counts of {counts.shape} cells, not {self.counts.shape}")
        rocks.restore(values["rocks"])
        self._begin(run, counts.astype(np.int32), rocks)

    def process(self, frame: CameraFrame) -> PerceptionResult:
        """Add one frame to the map; a frame of another run starts anew first.

        Raises FrameError for a frame that cannot be used, which leaves the map unchanged.
        """
        if frame.run.number != self._run.number:
            self._begin(frame.run, self._no_counts(), RockList())
        pose = self._validator.validate(frame)
        self._image = frame.image
        view = top_view(frame.image)
        ground = ground_mask(view)
        obstacle = ~ground & field_of_view()
        points = [rover_points(mask) for mask in (ground, obstacle, rock_mask(view))]
        if max(abs(pose.pitch), abs(pose.roll)) < self._config.baseline_tilt:
            self._add(points, pose, frame.stamp)
        return PerceptionResult(
            stamp=frame.stamp,
            nav=polar_array(*points[GROUND]),
            rock=polar_array(*points[ROCK]),
            scan=scan_of(nearest_obstacles(obstacle), self._config.max_range),
            rocks=self._rocks.rocks,
            map_stamp=self._schedule.newest(frame.stamp),
            run=frame.run,
        )

    def navigable(self, share: float | None = None) -> NDArray[np.bool_]:
        """Cells (rows, cols) with ground in any, or in at least a share, of their observations."""
        ground, observations = self.counts[..., GROUND], self.counts[..., :ROCK].sum(axis=2)
        if share is None:
            return np.asarray(ground > 0)
        return np.asarray((ground > 0) & (ground >= share * observations))

    def world_map(self) -> GridMap:
        """OccupancyGrid cells of `map_resolution`: -1 unknown, 0 navigable, 100 an obstacle."""
        return self._grid_map(self._config.map_resolution, self._cells())

    def navigation_map(self) -> GridMap:
        """The same, divided into cells of `evidence_resolution`."""
        resolution = self._config.evidence_resolution
        count = round(self._config.map_resolution / resolution)
        return self._grid_map(resolution, self._cells().repeat(count, 0).repeat(count, 1))

    def vision_image(self) -> NDArray[np.uint8] | None:
        """The newest camera image (height, width, 3) RGB, painted by the thresholds."""
        if self._image is None:
            return None
        ground = ground_mask(self._image)
        ground[:FIRST_ROW] = False
        obstacle = ~ground
        obstacle[:FIRST_ROW] = False
        return paint(self._image, ground, obstacle, rock_mask(self._image))

    def birdseye_image(self) -> NDArray[np.uint8] | None:
        """The newest image's top view (height, width, 3) RGB, coloured by the thresholds."""
        if self._image is None:
            return None
        view = top_view(self._image)
        ground = ground_mask(view)
        return colored(ground, ~ground & field_of_view(), rock_mask(view))

    def _add(self, points: list[Points], pose: Pose, stamp: int) -> None:
        """Count the points that are near enough in the cells of the map."""
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        for layer, (x, y) in enumerate(points):
            distance = np.hypot(x, y)
            near = distance < self._config.baseline_range
            east = pose.x + c * x[near] - s * y[near]
            north = pose.y + s * x[near] + c * y[near]
            row, col = self._geometry.cell_of(east, north)
            inside = self._geometry.contains(row, col)
            self.counts[row[inside], col[inside], layer] += 1
            if layer == ROCK and near.any():
                nearest = int(np.argmin(distance[near]))
                self._rocks.add(float(east[nearest]), float(north[nearest]), stamp)

    def _cells(self) -> NDArray[np.int8]:
        cells = np.full(self.counts.shape[:2], UNKNOWN, np.int8)
        cells[self.counts[..., OBSTACLE] > 0] = 100
        cells[self.navigable()] = 0
        return cells

    def _grid_map(self, resolution: float, cells: NDArray[np.int8]) -> GridMap:
        return GridMap(resolution, self._geometry.origin_x, self._geometry.origin_y, cells)
