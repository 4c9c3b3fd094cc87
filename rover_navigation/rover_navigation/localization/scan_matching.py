"""The pose at which a scan lies best on the walls of a map: Gauss-Newton, point to line.

The pose that the odometry predicts is one more measurement.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose, wrap_angle
from rover_navigation.localization.scan_points import transformed
from rover_navigation.localization.wall_lines import LineField, variance

# Neighbouring rays share the error of the line that they hit, so that they count for fewer.
INDEPENDENT_SHARE = 0.2
# [m] beyond which a point counts less and less, and soon not at all (Geman and McClure): what comes
# into sight for the first time lies on no line of the map, and would draw the scan to the nearest.
KERNEL = 0.05
ITERATIONS = 12
CONVERGED = 2e-4  # [m], [rad]


@dataclass(frozen=True)
class Match:
    """A pose, and how sure it is."""

    pose: Pose
    covariance: NDArray[np.float64]  # (3, 3) x, y [m], yaw [rad]


def match(
    points: NDArray[np.float64],
    lines: LineField,
    predicted: Pose,
    covariance: NDArray[np.float64],
) -> Match:
    """points (n, 2) [m] in base_footprint; covariance (3, 3) of the prediction."""
    prior = np.linalg.inv(covariance)
    start = np.array([predicted.x, predicted.y, predicted.yaw])
    state, information = start.copy(), prior
    sure = INDEPENDENT_SHARE / variance(np.hypot(points[:, 0], points[:, 1]))
    for _ in range(ITERATIONS):
        placed = transformed(points, Pose(*state))
        distance, normal, weight = lines.residuals(placed)
        arm = placed - state[:2]  # its derivative by the yaw is arm turned by 90 degrees
        turn = normal[:, 1] * arm[:, 0] - normal[:, 0] * arm[:, 1]
        jacobian = np.column_stack([normal, turn])
        weighted = jacobian.T * (sure * weight / (1.0 + (distance / KERNEL) ** 2) ** 2)
        information = prior + weighted @ jacobian
        step = np.linalg.solve(information, prior @ (start - state) - weighted @ distance)
        state += step
        if np.abs(step).max() < CONVERGED:
            break
    pose = Pose(float(state[0]), float(state[1]), wrap_angle(float(state[2])))
    return Match(pose, np.linalg.inv(information))
