"""Find what is warm, deliver a payload to each, climb the ramp."""

from __future__ import annotations

from functools import partial

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
