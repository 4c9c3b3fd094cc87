"""What messages of the heat mission say about places and temperatures."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import Pose
from rover_heat.ramp.hazards import Hazards, Strip
from rover_heat.thermal.picture import Celsius
from rover_heat.types import HeatOverlay, HeatSource
from rover_navigation.types import BlockedPlace
from rover_tools.report.heat_log import BLANK

ADD, CUBE = 0, 1  # of visualization_msgs/Marker


def sources_of(message: Any) -> tuple[HeatSource, ...]:
    """Of a HeatSourceArray; in the map frame."""
    return tuple(_source_of(source) for source in message.sources)


def overlay_of(message: Any, before: HeatOverlay) -> HeatOverlay:
    """Of a MarkerArray of heat_markers; sources stay, and so do faces where it has none."""
    points = {m.ns: _points(m.points) for m in message.markers if m.action == ADD and m.points}
    blocked = [m for m in message.markers if m.ns == "blocked" and m.action == ADD]
    goal = points["goal"][0].tolist() if "goal" in points else None
    return replace(
        before,
        hazards=Hazards(
            tuple(_strip_of(marker) for marker in blocked if marker.type == CUBE),
            tuple(_disc_of(marker) for marker in blocked if marker.type != CUBE),
        ),
        frontiers=points.get("frontiers", np.empty((0, 2))),
        faces=points.get("examined", before.faces),
        goal=None if goal is None else Pose(goal[0], goal[1], 0.0),
    )


def thermal_of(message: Any) -> Celsius:
    """Of a Float32MultiArray; blank where it is not of 64 values."""
    data = np.asarray(message.data, np.float32)
    return data.reshape(8, 8) if data.size == BLANK.size else BLANK


def _source_of(source: Any) -> HeatSource:
    xx, xy, yx, yy = map(float, source.covariance)
    at = source.position
    return HeatSource(
        source.id, at.x, at.y, (xx, xy, yx, yy), source.side, source.observations, source.peak,
        source.delivered,
    )  # fmt: skip


def _strip_of(marker: Any) -> Strip:
    at, turn, size = marker.pose.position, marker.pose.orientation, marker.scale
    yaw, half = 2.0 * math.atan2(turn.z, turn.w), size.x / 2
    start = Pose(at.x - half * math.cos(yaw), at.y - half * math.sin(yaw), yaw)
    return Strip(start, size.x, size.y)


def _disc_of(marker: Any) -> BlockedPlace:
    at = marker.pose.position
    return BlockedPlace(at.x, at.y, marker.scale.x / 2)


def _points(points: Any) -> NDArray[np.float64]:
    return np.array([(point.x, point.y) for point in points], float).reshape(-1, 2)
