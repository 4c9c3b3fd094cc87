"""The mission's report and its markers as messages."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from geometry_msgs.msg import Point
from rover_interfaces.msg import MissionState
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from rover_common import frames
from rover_common.ros.conversions import header_of
from rover_decision.memory import Memory
from rover_decision.types import Decision, Snapshot

BLUE, CYAN = ColorRGBA(b=1.0, g=0.4, a=1.0), ColorRGBA(b=1.0, g=1.0, a=0.8)
GREEN, YELLOW = ColorRGBA(g=0.8, a=1.0), ColorRGBA(r=1.0, g=0.8, a=1.0)
RED = ColorRGBA(r=1.0, a=0.6)


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
        recoveries=progress.recoveries,
    )


def markers_of(stamp: int, snapshot: Snapshot, memory: Memory) -> MarkerArray:
    """Trail, rocks, blocked places, and the plan: frontiers, goal and way."""
    plan = snapshot.plan
    way = np.empty((0, 2)) if plan is None else plan.way.points
    frontiers = np.empty((0, 2)) if plan is None else plan.frontiers
    goal = [] if plan is None or plan.goal is None else [(plan.goal.x, plan.goal.y)]
    rocks = [(rock.x, rock.y) for rock in snapshot.rocks]
    blocked = [(place.x, place.y) for place in memory.blocked]
    return MarkerArray(
        markers=[
            _marker(stamp, "crumbs", Marker.LINE_STRIP, 0.15, BLUE, memory.crumbs.points),
            _marker(stamp, "way", Marker.LINE_STRIP, 0.25, GREEN, way),
            _marker(stamp, "frontiers", Marker.SPHERE_LIST, 0.5, CYAN, frontiers),
            _marker(stamp, "goal", Marker.SPHERE_LIST, 1.0, GREEN, goal),
            _marker(stamp, "rocks", Marker.SPHERE_LIST, 0.6, YELLOW, rocks),
            _marker(stamp, "blocked", Marker.SPHERE_LIST, 1.0, RED, blocked),
        ]
    )


def _marker(
    stamp: int, name: str, kind: int, size: float, color: ColorRGBA, points: Iterable[Iterable]
) -> Marker:
    """Without points it takes away what was shown under its name."""
    at = [Point(x=float(x), y=float(y), z=0.1) for x, y in points]
    action = Marker.ADD if at else Marker.DELETE
    marker = Marker(header=header_of(stamp, frames.MAP), ns=name, type=kind, action=action)
    marker.pose.orientation.w = 1.0
    marker.scale.x = marker.scale.y = marker.scale.z = size
    marker.color = color
    marker.points = at
    return marker
