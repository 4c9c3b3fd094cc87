"""Whether the poses of a recorded run can be those of one drive."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose

MOST_SPEED = 6.0  # [m/s] the rover reaches 5
SLACK = 1.0  # [m] that a position may be off besides
# A row of wrong numbers is followed by right ones; after a new start the drive goes on there.
SHORTEST_DRIVE = 10  # frames
ENOUGH_MOTION = 1.0  # [m] to tell from where the rover looks
LEAST_STEP = 0.003  # [m] of a frame in which the rover moves at all
CONTRADICTED, FITTING = 0.6, 0.9  # mean cosines between motion and yaw: 53 and 26 degrees


def reachable(poses: Sequence[Pose], times: Sequence[float]) -> NDArray[np.bool_]:
    """Which poses (n,) belong to a drive, given their times [s].

    Where the way between two frames is longer than the rover's speed allows, a new part begins. A
    part of a few frames is an error of the log if no longer part beside it can be reached.
    """
    at = np.array([(pose.x, pose.y) for pose in poses]).reshape(-1, 2)
    when = np.asarray(times, float)

    def reached(one: int | NDArray[np.intp], other: int | NDArray[np.intp]) -> NDArray[np.bool_]:
        way = np.hypot(*(at[other] - at[one]).T)
        return np.asarray(way <= SLACK + MOST_SPEED * (when[other] - when[one]))

    every = np.arange(len(at))
    parts = np.split(every, np.flatnonzero(~reached(every[:-1], every[1:])) + 1)
    drives = [part for part in parts if len(part) >= SHORTEST_DRIVE]
    good = np.full(len(at), not drives)
    for part in parts:
        before = [drive[-1] for drive in drives if drive[-1] < part[0]][-1:]
        after = [drive[0] for drive in drives if drive[0] > part[-1]][:1]
        good[part] |= len(part) >= SHORTEST_DRIVE
        good[part] |= any(reached(one, part[0]) for one in before)
        good[part] |= any(reached(part[-1], one) for one in after)
    return good


def contradicts_yaw(poses: Sequence[Pose], speeds: Sequence[float]) -> tuple[bool, bool]:
    """Whether the motion contradicts the yaw, and whether it fits the other convention's.

    speeds [m/s]: forward positive. The conventions are each other's mirror image: of an angle a of
    the one, the other makes 90 degrees - a.
    """
    at = np.array([(pose.x, pose.y) for pose in poses]).reshape(-1, 2)
    yaw = np.array([pose.yaw for pose in poses[:-1]])
    steps = np.diff(at, axis=0) * np.where(np.array(speeds[:-1]) < 0.0, -1.0, 1.0)[:, None]
    ways = np.hypot(*steps.T)
    moved = (ways > LEAST_STEP) & (ways < SLACK)
    if ways[moved].sum() < ENOUGH_MOTION:
        return False, False
    cosines = [
        float((steps[moved] * np.stack([cos, sin], axis=1)[moved]).sum() / ways[moved].sum())
        for cos, sin in ((np.cos(yaw), np.sin(yaw)), (np.sin(yaw), np.cos(yaw)))
    ]
    return cosines[0] < CONTRADICTED, cosines[1] > FITTING
