"""The ground under the four wheels: how it tilts the body, and where it pushes it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER

# Height [m] of the ground at a point [m], and its rise per metre to the east and to the north.
Surface = Callable[[float, float], tuple[float, float, float]]
WHEELS = tuple(
    (ahead, aside)
    for ahead in (ROVER.front_axle, -ROVER.rear_axle)
    for aside in (ROVER.track / 2, -ROVER.track / 2)
)  # [m] in base_link: front left, front right, rear left, rear right


@dataclass(frozen=True)
class Ground:
    """What the wheels stand on; the default is the flat floor.

    The body stands on the plane of its wheels, but it rolls down the slopes below each of them.
    """

    height: float = 0.0  # [m] of the wheels' plane below the origin
    pitch: float = 0.0  # [rad] of the wheels' plane, nose down positive
    roll: float = 0.0  # [rad] of it, left side up positive
    ahead: float = 0.0  # rise of the slopes per metre forward, by the load of the wheels
    aside: float = 0.0  # the same per metre to the left


FLAT = Ground()
FLOOR = [(0.0, 0.0, 0.0)] * len(WHEELS)  # what a surface gives there


def ground_under(pose: Pose, surface: Surface) -> Ground:
    """Of a rover at a pose, from the heights and slopes of the ground at its four wheels."""
    c, s = math.cos(pose.yaw), math.sin(pose.yaw)
    spots = [surface(pose.x + c * a - s * b, pose.y + s * a + c * b) for a, b in WHEELS]
    if spots == FLOOR:
        return FLAT
    (h1, east1, north1), (h2, east2, north2), (h3, east3, north3), (h4, east4, north4) = spots
    front, rear = (h1 + h2) / 2, (h3 + h4) / 2
    pitch = math.atan2(rear - front, ROVER.wheelbase)
    roll = math.atan2((h1 + h3 - h2 - h4) / 2, ROVER.track)
    load1, load2, load3, load4 = _loads(pitch, roll)
    east = load1 * east1 + load2 * east2 + load3 * east3 + load4 * east4
    north = load1 * north1 + load2 * north2 + load3 * north3 + load4 * north4
    return Ground(
        (front * ROVER.rear_axle + rear * ROVER.front_axle) / ROVER.wheelbase,
        pitch,
        roll,
        c * east + s * north,
        c * north - s * east,
    )


def _loads(pitch: float, roll: float) -> tuple[float, float, float, float]:
    """Shares of the weight that the wheels carry, in their order.

    The centre of mass hangs below the wheels, so that those on the higher ground carry more. With
    these loads the slopes take the energy that it costs to lift and tilt the body.
    """
    front = (ROVER.rear_axle - ROVER.mass_depth * math.sin(pitch)) / ROVER.wheelbase
    left = 0.5 + ROVER.mass_depth * math.sin(roll) / ROVER.track
    front, left = max(0.0, min(1.0, front)), max(0.0, min(1.0, left))
    rear, right = 1.0 - front, 1.0 - left
    return front * left, front * right, rear * left, rear * right
