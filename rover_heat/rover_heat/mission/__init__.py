"""Find what is warm, deliver a payload to each, climb the ramp."""

from __future__ import annotations

from functools import partial

from rover_common.saved_state import Memory
from rover_common.types import Run
from rover_decision.core import DecisionCore
from rover_heat.config import HeatConfig
from rover_heat.mission.mission import HeatMission
from rover_heat.planning.planner import HeatPlanner
from rover_heat.planning.types import HeatPlan
from rover_heat.types import HeatDecision, HeatFrame, HeatOverlay
from rover_navigation.navigator import Navigator

HeatCore = DecisionCore[HeatFrame, HeatDecision, HeatPlan, HeatOverlay]


def make_core(config: HeatConfig, navigator: Navigator, lockstep: bool) -> HeatCore:
    """The decision core of this mission; lockstep: frames wait for their plans."""
    mission = partial(HeatMission, config, navigator)
    return DecisionCore(mission, HeatPlanner(config).plan, config.plan_delay, lockstep)


def memory_of(core: HeatCore) -> Memory:
    """What a core has to know that goes on with the mission at hand."""
    mission = core.mission
    assert isinstance(mission, HeatMission)
    return mission.memory()


def resume(
    core: HeatCore,
    config: HeatConfig,
    navigator: Navigator,
    run: Run,
    memory: Memory,
    places: bool = True,
) -> None:
    """Let a core go on with a mission of this run; places: also with what it knew of its map.

    Raises ValueError, TypeError or KeyError for a memory that is none, and changes nothing then.
    """
    mission = HeatMission(config, navigator)
    mission.restore(memory, places)
    core.resume(run, mission)
