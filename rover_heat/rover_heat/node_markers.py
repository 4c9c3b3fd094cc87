"""What the mission knows about places, as markers in the map frame."""

from __future__ import annotations

import math
from collections.abc import Iterable

from geometry_msgs.msg import Point, Vector3
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from rover_common.frames import FRAMES, Frames
from rover_common.ros.conversions import header_of
from rover_heat.ramp.hazards import Hazards, Strip
from rover_heat.types import HeatOverlay, HeatSource

GREEN, BLUE = ColorRGBA(g=0.8, a=1.0), ColorRGBA(b=1.0, g=0.4, a=1.0)
RED, YELLOW = ColorRGBA(r=1.0, a=0.6), ColorRGBA(r=1.0, g=0.8, a=1.0)
GREY, WHITE = ColorRGBA(r=0.6, g=0.6, b=0.6, a=0.6), ColorRGBA(r=1.0, g=1.0, b=1.0, a=1.0)
HEAT_Z = 0.2  # [m] where a source is about
LEAST, MOST, SURE = 0.06, 0.20, 50  # [m] size of a source's sphere, and fixes from which it is full
FLAT = 0.01  # [m] height of what lies on the ground
BLOCKED_HEIGHT = 0.06  # [m] that of the ramp
Places = Iterable[Iterable[float]]


def markers_of(stamp: int, overlay: HeatOverlay, frames: Frames = FRAMES) -> MarkerArray:
    """First all before are taken away."""
    header = header_of(stamp, frames.map)
    goal = [] if overlay.goal is None else [(overlay.goal.x, overlay.goal.y)]
    return MarkerArray(
        markers=[
            Marker(header=header, action=Marker.DELETEALL),
            *(_sphere(header, source) for source in overlay.sources),
            *_blocked(header, overlay.hazards),
            _discs(header, "frontiers", 0.10, YELLOW, overlay.frontiers),
            _discs(header, "visited", 0.08, GREY, overlay.visited),
            _discs(header, "goal", 0.14, GREEN, goal),
            _marker(header, "trail", Marker.LINE_STRIP, (0.01, 0.0, 0.0), BLUE, overlay.trail),
            _marker(header, "examined", Marker.CUBE_LIST, (0.02, 0.02, FLAT), WHITE, overlay.faces),
        ]
    )


def _sphere(header: Header, source: HeatSource) -> Marker:
    """Bigger with evidence."""
    size = LEAST + (MOST - LEAST) * min(1.0, source.observations / SURE)
    color = BLUE if source.delivered else GREEN
    marker = _marker(header, "heat", Marker.SPHERE, (size, size, size), color, ())
    marker.id, marker.action = source.id, Marker.ADD
    marker.pose.position = Point(x=source.x, y=source.y, z=HEAT_Z)
    return marker


def _blocked(header: Header, hazards: Hazards) -> Iterable[Marker]:
    for number, strip in enumerate(hazards.strips):
        yield _strip(header, number, strip)
    for number, disc in enumerate(hazards.discs, len(hazards.strips)):
        size = (2 * disc.radius, 2 * disc.radius, BLOCKED_HEIGHT)
        marker = _marker(header, "blocked", Marker.CYLINDER, size, RED, ())
        marker.id, marker.action = number, Marker.ADD
        marker.pose.position = Point(x=disc.x, y=disc.y, z=BLOCKED_HEIGHT / 2)
        yield marker


def _strip(header: Header, number: int, strip: Strip) -> Marker:
    size = (strip.length, strip.width, BLOCKED_HEIGHT)
    marker = _marker(header, "blocked", Marker.CUBE, size, RED, ())
    marker.id, marker.action = number, Marker.ADD
    start, half = strip.start, strip.length / 2
    x, y = start.x + half * math.cos(start.yaw), start.y + half * math.sin(start.yaw)
    marker.pose.position = Point(x=x, y=y, z=BLOCKED_HEIGHT / 2)
    marker.pose.orientation.z = math.sin(start.yaw / 2)
    marker.pose.orientation.w = math.cos(start.yaw / 2)
    return marker


def _discs(header: Header, name: str, size: float, color: ColorRGBA, places: Places) -> Marker:
    return _marker(header, name, Marker.SPHERE_LIST, (size, size, FLAT), color, places)


def _marker(
    header: Header,
    name: str,
    kind: int,
    size: tuple[float, float, float],
    color: ColorRGBA,
    places: Places,
) -> Marker:
    """Without places it takes away what was shown under its name."""
    at = [Point(x=float(x), y=float(y), z=FLAT) for x, y in places]
    action = Marker.ADD if at else Marker.DELETE
    marker = Marker(header=header, ns=name, type=kind, action=action)
    marker.pose.orientation.w = 1.0
    marker.scale = Vector3(x=float(size[0]), y=float(size[1]), z=float(size[2]))
    marker.color = color
    marker.points = at
    return marker
