"""The mission's report and its markers as messages."""

from __future__ import annotations

import numpy as np
from geometry_msgs.msg import Point
from rover_interfaces.msg import MissionState
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from rover_common import frames
from rover_common.conversions import header_of
from rover_common.dataflow import Rock
from rover_decision.dataflow import Decision


def mission_state_of(stamp: int, decision: Decision) -> MissionState:
    progress = decision.progress
    return MissionState(
        header=header_of(stamp, frames.MAP),
        state=int(decision.state),
        state_name=decision.state.name,
        reason=decision.reason,
        elapsed=progress.elapsed,
        explored=progress.explored,
        samples_total=progress.samples_total,
        samples_collected=progress.samples_collected,
        rocks_known=progress.rocks_known,
        rocks_given_up=progress.rocks_given_up,
        home_distance=progress.home_distance,
        distance=progress.distance,
    )


def markers_of(stamp: int, crumbs: np.ndarray, rocks: tuple[Rock, ...]) -> MarkerArray:
    """Crumbs (n, 2) [m] as a line, rocks as spheres."""
    trail = _marker(stamp, "crumbs", Marker.LINE_STRIP, 0.15, ColorRGBA(b=1.0, g=0.4, a=1.0))
    trail.points = [Point(x=float(x), y=float(y), z=0.05) for x, y in crumbs]
    found = _marker(stamp, "rocks", Marker.SPHERE_LIST, 0.6, ColorRGBA(r=1.0, g=0.8, a=1.0))
    found.points = [Point(x=rock.x, y=rock.y, z=0.1) for rock in rocks]
    return MarkerArray(markers=[trail, found])


def _marker(stamp: int, name: str, kind: int, size: float, color: ColorRGBA) -> Marker:
    marker = Marker(header=header_of(stamp, frames.MAP), ns=name, type=kind, action=Marker.ADD)
    marker.pose.orientation.w = 1.0
    marker.scale.x = marker.scale.y = marker.scale.z = size
    marker.color = color
    return marker
