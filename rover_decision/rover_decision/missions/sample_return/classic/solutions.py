"""The two solutions, put together."""

from __future__ import annotations

from typing import Any

from statemachine import StateChart

from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.classic import states_a as a
from rover_decision.missions.sample_return.classic import states_b as b
from rover_decision.missions.sample_return.classic.chart_a import ClassicAChart
from rover_decision.missions.sample_return.classic.chart_b import ClassicBChart
from rover_decision.missions.sample_return.classic.commands import stop
from rover_decision.missions.sample_return.classic.homing import Homing
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.explorer import Explorer, Preset
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.solution import Solution
from rover_decision.missions.sample_return.states.pickup import Pickup
from rover_decision.missions.sample_return.states.standing import Standing
from rover_decision.missions.sample_return.tick import StateBehavior


def classic_a(config: DecisionConfig, parts: Parts, drivers: Drivers) -> Solution:
    """Wall following with breadcrumbs."""
    memory = a.MemoryA(parts, Homing(parts, drivers), config.nav_cell)
    states: dict[State, StateBehavior] = {
        State.FORWARD: a.ForwardA(memory),
        State.STOP: a.StopA(memory),
        State.ROCK_APPROACH: a.RockApproachA(memory),
        State.STUCK: a.StuckA(memory),
        State.CIRCLE: a.PushA(memory),
        State.RETURN_HOME: a.ReturnHomeA(memory),
    }
    return _solution(ClassicAChart, states, memory)


def classic_b(config: DecisionConfig, parts: Parts, drivers: Drivers) -> Solution:
    """Wall following with a bias, side clearance, stuck and circle."""
    memory = b.MemoryB(parts, Homing(parts, drivers), config)
    states: dict[State, StateBehavior] = {
        State.FORWARD: b.ForwardB(memory),
        State.STOP: b.StopB(memory),
        State.ROCK_APPROACH: b.RockApproachB(memory),
        State.STUCK: b.StuckB(memory),
        State.CIRCLE: b.CircleB(memory),
        State.RETURN_HOME: b.ReturnHomeB(memory),
    }
    return _solution(ClassicBChart, states, memory)


def _solution(
    chart: type[StateChart], states: dict[State, StateBehavior], memory: a.MemoryA | b.MemoryB
) -> Solution:
    """With the states in which both stand."""
    standing: dict[State, StateBehavior] = {
        State.IDLE: Standing("waits for the first frame", Event.start),
        State.PICKUP: Pickup(ROVER.standing_speed, stop()),
        State.DONE: Standing("the mission is over"),
        State.PAUSED: Standing("paused"),
    }
    everything = states | standing
    return Solution(chart, everything, memory.observe, memory.commanded, breadcrumb_path=False)


NO_TIME_LIMIT = 36000.0  # [s] the documents know none
COUNTED: dict[str, Any] = {"nav_cell": 0.1, "time_limit": NO_TIME_LIMIT}  # in the baseline's cells
BASELINE: dict[str, Any] = {"recipe": "baseline"}
# A maps every frame, and all of it: without the range and the tilt limit that B has.
UNLIMITED: dict[str, Any] = {"baseline_range": 30.0, "baseline_tilt": 1.6}
CLASSIC_A = Explorer(
    solution=classic_a,
    preset=Preset(
        "breadcrumbs",
        COUNTED | {"complete_at": 0.98, "complete_rule": "any"},
        BASELINE | UNLIMITED,
        knows_truth=True,
    ),
)
CLASSIC_B = Explorer(solution=classic_b, preset=Preset("bearing", COUNTED, BASELINE))
