"""What B's author wished for: a left turn after a pickup, and to avoid ground already visited."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import Command
from rover_decision.missions.sample_return.classic.commands import HARD, coast
from rover_decision.missions.sample_return.classic.ground import Ground

LEFT_TURN_SECONDS = 2.0  # [s] in place: 90 degrees at 45 a second
VISITED_RADIUS = 2  # [cells] around the rover


def left_turn(since: float) -> Command | None:
    """The turn `since` [s] after a pickup; None when it is over."""
    return coast(HARD) if since < LEFT_TURN_SECONDS else None


class VisitedGround:
    """Cells of 1 m that the rover has been near to."""

    def __init__(self) -> None:
        self._grid = GridGeometry.of_world(1.0)
        self._visited = np.zeros((self._grid.rows, self._grid.cols), bool)

    def visit(self, pose: Pose) -> None:
        """Once per frame."""
        row, col = map(int, self._grid.cell_of(pose.x, pose.y))
        rows = slice(max(0, row - VISITED_RADIUS), row + VISITED_RADIUS + 1)
        cols = slice(max(0, col - VISITED_RADIUS), col + VISITED_RADIUS + 1)
        self._visited[rows, cols] = True

    def weights(self, ground: Ground, pose: Pose, avoidance: float) -> NDArray[np.float64]:
        """(n,) of the ground's points: 1, less the avoidance (0..1) where it has been."""
        angle = ground.bearings + pose.yaw
        x = pose.x + ground.ranges * np.cos(angle)
        y = pose.y + ground.ranges * np.sin(angle)
        row, col = self._grid.nearest_cell_to(x, y)
        least = 1e-6  # so that ground visited everywhere still has a mean
        return np.where(self._visited[row, col], max(least, 1.0 - avoidance), 1.0)
