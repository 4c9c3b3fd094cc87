"""The solutions by the explorers' names: our own for those that plan, and the classics."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import MissionChart, State
from rover_decision.missions.sample_return.classic.solutions import classic_a, classic_b
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.solution import Solution
from rover_decision.missions.sample_return.states import make_states

# Also where a recovery interrupts the approach again and again.
APPROACHING = frozenset({State.ROCK_APPROACH, State.TILT, State.STUCK})


def planned(config: DecisionConfig, parts: Parts, drivers: Drivers) -> Solution:
    """Along the plans of an explorer that the parameters name, and which may change."""
    states = make_states(config, parts, drivers)
    return Solution(MissionChart, states, approaching=APPROACHING)


CLASSICS = {"classic_a": classic_a, "classic_b": classic_b}


def kind_of(config: DecisionConfig) -> str:
    """Explorers of one kind share a solution."""
    return config.explorer if config.explorer in CLASSICS else "planned"


def make_solution(config: DecisionConfig, parts: Parts, drivers: Drivers) -> Solution:
    """The one of the explorer that the parameters name."""
    return CLASSICS.get(config.explorer, planned)(config, parts, drivers)
