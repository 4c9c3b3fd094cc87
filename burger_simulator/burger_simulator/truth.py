"""What is true, for scoring and for tests; nothing that drives the robot may read it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from burger_simulator.model.physics import Physics
from burger_simulator.world.maze import Ramp
from rover_common.burger import BURGER
from rover_common.geometry import Pose

SEPARATE = 0.5  # [s] without a touch, after which another one counts as another


@dataclass(frozen=True)
class Launch:
    """The signal that began a sequence."""

    time: float  # [s]
    pose: Pose
    speed: float  # [m/s]
    turn_rate: float  # [rad/s]


@dataclass(frozen=True)
class Truth:
    time: float  # [s]
    pose: Pose  # of base_footprint in the world frame
    z: float  # [m]
    speed: float  # [m/s] forward positive
    turn_rate: float  # [rad/s] left positive
    distance: float  # [m] driven
    contacts: int  # separate touches of walls, with whatever part of the robot
    touching: bool  # a wall, now
    ramp_contacts: int  # separate touches of the ramp with the body
    beyond_foot: float  # [m] of the axle up the ramp, 0 where it is not above it
    on_flat: bool  # wheels and caster are above the ramp's flat part
    launches: tuple[Launch, ...]


class TouchCounter:
    """Counts touches that are apart in time."""

    def __init__(self) -> None:
        self.count = 0
        self.touching = False
        self._untouched = math.inf  # [s]

    def update(self, touching: bool, seconds: float) -> None:
        """`seconds` after the last update."""
        self.touching = touching
        if not touching:
            self._untouched += seconds
            return
        self.count += self._untouched > SEPARATE
        self._untouched = 0.0


class TruthKeeper:
    """Follows the physics."""

    def __init__(self, physics: Physics, ramp: Ramp | None) -> None:
        self._physics, self._ramp = physics, ramp
        self._walls, self._ramp_body = TouchCounter(), TouchCounter()
        self._distance = 0.0
        self._last = physics.position.copy()
        self._launches: list[Launch] = []

    def follow(self, seconds: float) -> None:
        """Once in each step."""
        wall, ramp = self._physics.touches()
        self._walls.update(wall, seconds)
        self._ramp_body.update(ramp, seconds)

    def measure_distance(self) -> None:
        """Once in each tick."""
        dx, dy, _ = self._physics.position - self._last
        self._distance += math.hypot(dx, dy)
        self._last = self._physics.position.copy()

    def moved(self) -> None:
        """The robot was put somewhere else: that is no way that it has driven."""
        self._last = self._physics.position.copy()

    def launched(self, time: float) -> None:
        physics = self._physics
        self._launches.append(Launch(time, physics.pose, physics.speed, physics.turn_rate))

    def at(self, time: float) -> Truth:
        pose = self._physics.pose
        return Truth(
            time=time,
            pose=pose,
            z=float(self._physics.position[2]),
            speed=self._physics.speed,
            turn_rate=self._physics.turn_rate,
            distance=self._distance,
            contacts=self._walls.count,
            touching=self._walls.touching,
            ramp_contacts=self._ramp_body.count,
            beyond_foot=_beyond_foot(self._ramp, pose),
            on_flat=stands_on_flat(self._ramp, pose),
            launches=tuple(self._launches),
        )


def stands_on_flat(ramp: Ramp | None, pose: Pose) -> bool:
    """Whether wheels and caster are above the ramp's flat part."""
    if ramp is None:
        return False
    cos, sin = math.cos(pose.yaw), math.sin(pose.yaw)
    aside = BURGER.wheel_separation / 2
    feet = ((0.0, aside), (0.0, -aside), (BURGER.caster_x, 0.0))
    for forward, left in feet:
        x, y = pose.x + cos * forward - sin * left, pose.y + sin * forward + cos * left
        along, across = ramp.along_and_across(x, y)
        flat = 0.0 <= along - ramp.slope_length <= ramp.flat_length
        if not (flat and abs(across) <= ramp.width / 2):
            return False
    return True


def _beyond_foot(ramp: Ramp | None, pose: Pose) -> float:
    """One wheel on the ramp is enough."""
    if ramp is None:
        return 0.0
    along, across = ramp.along_and_across(pose.x, pose.y)
    above = abs(across) <= (ramp.width + BURGER.wheel_separation) / 2 and along <= ramp.length
    return max(0.0, along) if above else 0.0
