"""The mission's report, its path and its markers as messages."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from geometry_msgs.msg import Point, PoseStamped, Quaternion
from geometry_msgs.msg import Pose as PoseMsg
from nav_msgs.msg import Path as PathMsg
from rover_interfaces.msg import MissionState
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from rover_common.frames import FRAMES, Frames
from rover_common.ros.conversions import header_of
from rover_common.types import RockTrack, Run
from rover_decision.types import Decision, Overlay
from rover_navigation.types import NO_POINTS, Path

BLUE, CYAN = ColorRGBA(b=1.0, g=0.4, a=1.0), ColorRGBA(b=1.0, g=1.0, a=0.8)
GREEN, YELLOW = ColorRGBA(g=0.8, a=1.0), ColorRGBA(r=1.0, g=0.8, a=1.0)
RED = ColorRGBA(r=1.0, a=0.6)


def mission_state_of(
    stamp: int, run: Run, decision: Decision, frames: Frames = FRAMES
) -> MissionState:
    progress = decision.progress
    return MissionState(
        header=header_of(stamp, frames.map),
        state=int(decision.state),
        run=run.number,
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


def path_message_of(stamp: int, path: Path, frames: Frames = FRAMES) -> PathMsg:
    """The poses of a path face along it."""
    header = header_of(stamp, frames.map)
    steps = np.diff(path.points, axis=0, append=path.points[-1:])
    yaws = np.arctan2(steps[:, 1], steps[:, 0])
    yaws[-1:] = yaws[-2:-1] if len(yaws) > 1 else 0.0
    return PathMsg(
        header=header,
        poses=[
            PoseStamped(
                header=header,
                pose=PoseMsg(
                    position=Point(x=float(x), y=float(y), z=0.0),
                    orientation=Quaternion(z=float(np.sin(yaw / 2)), w=float(np.cos(yaw / 2))),
                ),
            )
            for (x, y), yaw in zip(path.points, yaws, strict=True)
        ],
    )


def markers_of(
    stamp: int, rocks: tuple[RockTrack, ...], overlay: Overlay, frames: Frames = FRAMES
) -> MarkerArray:
    """Breadcrumbs, rocks, blocked places, and the plan: frontiers, goal and path."""
    plan = overlay.plan
    path = NO_POINTS if overlay.path is None else overlay.path.points
    goal = [] if plan is None or plan.goal is None else [(plan.goal.x, plan.goal.y)]
    rock_points = [(rock.x, rock.y) for rock in rocks]
    blocked = [(place.x, place.y) for place in overlay.blocked]
    header = header_of(stamp, frames.map)
    return MarkerArray(
        markers=[
            _marker(header, "breadcrumbs", Marker.LINE_STRIP, 0.15, BLUE, overlay.breadcrumbs),
            _marker(header, "path", Marker.LINE_STRIP, 0.25, GREEN, path),
            _marker(header, "frontiers", Marker.SPHERE_LIST, 0.5, CYAN, overlay.frontiers),
            _marker(header, "goal", Marker.SPHERE_LIST, 1.0, GREEN, goal),
            _marker(header, "rocks", Marker.SPHERE_LIST, 0.6, YELLOW, rock_points),
            _marker(header, "blocked", Marker.SPHERE_LIST, 1.0, RED, blocked),
        ]
    )


def _marker(
    header: Header, name: str, kind: int, size: float, color: ColorRGBA, points: Iterable[Iterable]
) -> Marker:
    """Without points it takes away what was shown under its name."""
    at = [Point(x=float(x), y=float(y), z=0.1) for x, y in points]
    action = Marker.ADD if at else Marker.DELETE
    marker = Marker(header=header, ns=name, type=kind, action=action)
    marker.pose.orientation.w = 1.0
    marker.scale.x = marker.scale.y = marker.scale.z = size
    marker.color = color
    marker.points = at
    return marker
