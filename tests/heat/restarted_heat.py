"""A heat mission, and another one that goes on with what it knew."""

from __future__ import annotations

import copy
import json

import numpy as np
from driven_heat import GRID, DrivenHeat
from made_fixes import fix
from reached_heat import (
    launching,
)

from rover_common.geometry import Pose
from rover_common.saved_state import Memory
from rover_heat.config import HeatConfig
from rover_heat.planning.types import GoalKind, HeatGoal
from rover_heat.tilt import Lean
from rover_navigation.types import NO_POINTS

AHEAD = HeatGoal(GoalKind.FRONTIER, Pose(3.0, 3.0, 0.0), 3.4, 3.0, 5.0)


def kept(memory: Memory) -> Memory:
    """As it comes from a file."""
    return json.loads(json.dumps(memory[0])), copy.deepcopy(memory[1])


def again(driven: DrivenHeat, seconds: float = 3.0, places: bool = True) -> DrivenHeat:
    """The same robot, with another mission that goes on with this one after a while."""
    other = DrivenHeat(driven.config, driven.room)
    other.mission.restore(kept(driven.mission.memory()), places)
    other.pose, other.plan, other.time = driven.pose, driven.plan, driven.time + seconds
    return other


def eventful() -> DrivenHeat:
    """Has met a ramp, given up a goal, served a source, examined walls, and found warm places."""
    driven = launching(HeatConfig(deliver="at_once"))
    driven.until(lambda made: made.launch, 5.0)
    driven.tick(launches_done=1)
    parts = driven.mission.parts
    parts.ramps.meet(Pose(1.0, 1.0, 0.5), Lean(0.0, -0.1), NO_POINTS)
    parts.goals.failed(driven.time, AHEAD)
    parts.goals.viewed_in_vain(np.array([(1.0, 0.5)]))
    parts.sensing.fixes.append(fix(2.0, 4.0))
    parts.sensing.coverage.give_up(np.array([(0.5, 0.5), (1.0, 0.5)]))
    driven.ticks(1.0)
    return driven


def request_of(driven: DrivenHeat) -> dict:
    """What a plan would be made of, but for the moment."""
    request = driven.mission.plan_request(driven.frame())(GRID)
    known = dict(vars(request))
    examined = known.pop("examined")
    for each in ("stamp", "grid", "goal"):
        del known[each]
    arrays = {k: v.tolist() for k, v in known.items() if isinstance(v, np.ndarray)}
    return known | arrays | {"keys": examined.keys.tolist(), "sectors": examined.sectors.tolist()}
