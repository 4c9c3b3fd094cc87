"""The mission's own solution: along the plans of an explorer."""

from __future__ import annotations

from rover_decision.missions.sample_return.chart import MissionChart, State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.solution import Solution
from rover_decision.missions.sample_return.states import make_states

# Also where a recovery interrupts the approach again and again.
APPROACHING = frozenset({State.ROCK_APPROACH, State.TILT, State.STUCK})


def planned(config: DecisionConfig, parts: Parts, drivers: Drivers) -> Solution:
    """Along the plans of the explorer that the parameters name, and which may change."""
    states = make_states(config, parts, drivers)
    return Solution(MissionChart, states, approaching=APPROACHING)
