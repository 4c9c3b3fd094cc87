"""The project's own recipes."""

from __future__ import annotations

import math

from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_perception.baseline.perception import BaselinePerception
from rover_perception.baseline.top_view import FIRST_ROW
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import ABOVE_HORIZON, NEAREST_ROWS
from rover_perception.factory import Recipe
from rover_perception.perception import Perception

# [px] The telemetry's pose is rounded, so perception may find the horizon one row higher.
POSE_ROUNDING = 1


def first_row_read(pose: Pose) -> int:
    """The first row that is read of an image taken at this pose; 0 for one that is refused."""
    projection = GroundProjection.of(ROVER_CAMERA, pose)
    if not projection.usable:
        return 0
    row = math.floor(projection.highest_horizon) - ABOVE_HORIZON - POSE_ROUNDING
    return min(max(row, 0), ROVER_CAMERA.height - NEAREST_ROWS)


EXACT = Recipe(Perception, first_row_read)
BASELINE = Recipe(BaselinePerception, lambda pose: FIRST_ROW)  # the same at every pose
