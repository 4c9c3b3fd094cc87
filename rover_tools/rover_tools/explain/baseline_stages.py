"""The baseline's stages on one frame: all that this package knows of how the baseline works."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.types import CameraFrame, GridMap, PerceptionResult
from rover_perception.baseline.perception import BaselinePerception
from rover_perception.baseline.rock_list import RockList
from rover_perception.baseline.thresholds import ground_mask, rock_mask
from rover_perception.baseline.top_view import (
    BOTTOM_OFFSET,
    CELLS_PER_METRE,
    SQUARE,
    field_of_view,
    homography,
    rover_points,
    top_view,
)
from rover_perception.baseline.view_scan import nearest_obstacles
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameError
from rover_perception.polar import polar_array
from rover_tools.explain.naming import name_of

__all__ = ["BOTTOM_OFFSET", "CELLS_PER_METRE", "NAMES", "SQUARE", "BaselineStages", "run_baseline"]

Mask = NDArray[np.bool_]
NAMES = {
    "grid": (name_of(homography),),
    "top view": (name_of(top_view),),
    "field of view": (name_of(field_of_view),),
    "threshold": (name_of(ground_mask),),
    "rocks": (name_of(rock_mask),),
    "rover-centric": (name_of(rover_points),),
    "world": (name_of(BaselinePerception.world_map), name_of(RockList.add)),
    "polar arrays": (name_of(polar_array), name_of(nearest_obstacles)),
}


@dataclass(frozen=True)
class BaselineStages:
    """One frame; a top view is (160, 320), with the rover below its middle."""

    image: NDArray[np.uint8]
    pose: Pose
    warp: NDArray[np.float64]  # (3, 3) image to top view
    top_view: NDArray[np.uint8]  # (160, 320, 3) RGB
    in_view: Mask
    ground: Mask
    obstacle: Mask
    rock: Mask
    updates: bool  # whether the frame is level enough to change the map
    most_range: float  # [m] of points that are mapped
    grid: GridMap  # of all frames
    result: PerceptionResult


def run_baseline(frames: Sequence[CameraFrame]) -> BaselineStages:
    """Map all frames and keep the stages of the last one. Raises FrameError."""
    config = PerceptionConfig(recipe="baseline")
    core = BaselinePerception(config)
    for earlier in frames[:-1]:
        with suppress(FrameError):
            core.process(earlier)
    frame = frames[-1]
    result = core.process(frame)
    view = top_view(frame.image)
    ground, in_view = ground_mask(view), field_of_view()
    tilt = max(abs(frame.pose.pitch), abs(frame.pose.roll))
    return BaselineStages(
        frame.image, frame.pose, homography(), view, in_view, ground, ~ground & in_view,
        rock_mask(view), tilt < config.baseline_tilt, config.baseline_range, core.world_map(),
        result,
    )  # fmt: skip
