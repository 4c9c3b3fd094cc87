"""What a mission needs to know that goes on after its node was killed.

Apart from each other: what is true of the robot wherever it is, and what is of places, which is
void in another map. Left out are the plan, which is made anew within a second, the monitors of the
last seconds, and the goal at hand.
"""

from __future__ import annotations

from typing import Any

from rover_common.geometry import Pose
from rover_common.saved_state import Memory, joined, part_of
from rover_heat.mission.parts import HeatParts


def memory_of(parts: HeatParts) -> Memory:
    """The arrays are copies, or grow at their ends alone."""
    return joined(robot=(_robot(parts), {}), places=_places(parts))


def restore(parts: HeatParts, memory: Memory, places: bool) -> None:
    """Give new parts what `memory_of` gave; places: also what is of the map.

    Raises ValueError, TypeError or KeyError for anything else.
    """
    robot, _ = part_of(memory, "robot")
    parts.begun = float(robot["begun"])
    parts.inputs.distance = float(robot["distance"])
    parts.agenda.payloads = int(robot["payloads"])
    parts.launcher_works_until = float(robot["launcher_works_until"])
    parts.tilt.restore(robot["tilt"])
    parts.sensing.restore(robot["thermal"])
    if places:
        _restore_places(parts, part_of(memory, "places"))


def _robot(parts: HeatParts) -> dict[str, Any]:
    return {
        "begun": parts.begun,
        "distance": parts.inputs.distance,
        "payloads": parts.agenda.payloads,
        "launcher_works_until": parts.launcher_works_until,
        "tilt": parts.tilt.memory(),
        "thermal": parts.sensing.memory(),
    }


def _places(parts: HeatParts) -> Memory:
    agenda, start = parts.agenda, parts.start
    known = {
        "start": None if start is None else [start.x, start.y, start.yaw],
        "explored": agenda.explored,
        "ramp_given_up": agenda.ramp_given_up,
        "back": agenda.back,
        "sources": parts.sources.memory(),
        "ramps": parts.ramps.memory(),
        "goals": parts.goals.memory(),
        "track": parts.track.memory(),
    }
    trail: Memory = {}, {"trail": parts.trail.points}
    return joined(known=(known, {}), thermal=parts.sensing.places(), driven=trail)


def _restore_places(parts: HeatParts, memory: Memory) -> None:
    known, _ = part_of(memory, "known")
    agenda, start = parts.agenda, known["start"]
    parts.start = None if start is None else Pose(*map(float, start))
    agenda.explored, agenda.back = bool(known["explored"]), bool(known["back"])
    agenda.ramp_given_up = bool(known["ramp_given_up"])
    parts.sources.restore(known["sources"])
    parts.ramps.restore(known["ramps"])
    parts.goals.restore(known["goals"])
    parts.track.restore(known["track"])
    parts.sensing.restore_places(part_of(memory, "thermal"))
    parts.trail.restore(part_of(memory, "driven")[1]["trail"])
