"""Sample return: explore an unknown canyon, collect the rock samples, come home."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from rover_common.ground_truth import load_truth
from rover_common.saved_state import Memory
from rover_common.types import Run
from rover_decision.core import DecisionCore
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.explorers import SELECTIONS
from rover_decision.missions.sample_return.mission import SampleReturnMission
from rover_decision.missions.sample_return.rover_scale import ROVER_SCALE
from rover_decision.types import Decision, Frame, Overlay
from rover_navigation.planner import Planner
from rover_navigation.selection import WholeTour
from rover_navigation.types import Plan

SampleReturnCore = DecisionCore[Frame, Decision, Plan, Overlay]


def make_planner(config: DecisionConfig) -> Planner:
    """The planner that the parameters name; raises TruthError for a truth that cannot be read."""
    selection = SELECTIONS.get(config.explorer, WholeTour)
    truth = load_truth(Path(config.truth)) if config.truth else None
    return Planner(ROVER_SCALE, selection(ROVER_SCALE), truth)


def configure(core: SampleReturnCore, config: DecisionConfig) -> None:
    """Let a core of this mission go on with other parameters."""
    core.configure(config, partial(SampleReturnMission, config), make_planner(config).plan)


def memory_of(core: SampleReturnCore) -> Memory:
    """What a core has to know that goes on with the mission at hand."""
    mission = core.mission
    assert isinstance(mission, SampleReturnMission)
    return mission.memory()


def resume(core: SampleReturnCore, config: DecisionConfig, run: Run, memory: Memory) -> None:
    """Let a core that has seen no frame go on with a mission of this run.

    Raises ValueError, TypeError or KeyError for a memory that is none, and changes nothing then.
    """
    mission = SampleReturnMission(config)
    mission.restore(memory)
    core.resume(run, mission)


def make_core(config: DecisionConfig, lockstep: bool) -> SampleReturnCore:
    """The decision core of this mission; lockstep: frames wait for their plans."""
    mission = partial(SampleReturnMission, config)
    return DecisionCore(mission, make_planner(config).plan, config.plan_delay, lockstep)
