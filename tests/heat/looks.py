"""Views of a room by a thermal sensor, for the coverage."""

from __future__ import annotations

from warm_room import Room, hits_of

from rover_common.geometry import Pose
from rover_heat.thermal.coverage import Coverage
from rover_heat.thermal.fix import View


def look(coverage: Coverage, pose: Pose, room: Room, numbers=(1, 2), sensor: int = 2) -> None:
    for number in numbers:
        coverage.update(View(0, sensor, pose, 0.0, 0.0, hits_of(room, pose)), number)
