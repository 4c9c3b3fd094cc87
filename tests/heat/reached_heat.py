"""Missions in each of their states."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from functools import cache, wraps
from typing import Any

from driven_heat import APPROACH, RAMP, RAMP_PITCH, SOURCE, STAND, DrivenHeat

from rover_decision.types import Request
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_heat.planning.types import HeatPlan
from rover_navigation.types import PlanFailed

FAILURE = PlanFailed(1, "it did not come")


def copied(make: Callable[..., DrivenHeat]) -> Callable[..., DrivenHeat]:
    """Made once for each config, then copied: many tests begin with the same mission."""
    made = cache(make)
    return wraps(make)(lambda config=None: deepcopy(made(config)))


@copied
def exploring(config: HeatConfig | None = None) -> DrivenHeat:
    """On its way to a first goal."""
    driven = DrivenHeat(config)
    driven.until_state(State.EXPLORING, 5.0)
    driven.until(lambda _: bool(driven.navigator.goals), 3.0)
    return driven


def explored_plan(**what: Any) -> HeatPlan:
    """Nothing is left to see; a source, its stand-off, a ramp and its approach are known."""
    parts: dict[str, Any] = {"sources": (SOURCE,), "stand_offs": ((STAND,),), "explored": 1.0}
    return HeatPlan(0, **(parts | what))


@copied
def navigating(config: HeatConfig | None = None) -> DrivenHeat:
    """On its way to a source."""
    driven = exploring(config)
    driven.arrive()
    driven.plan = explored_plan()
    driven.until_state(State.GOAL_NAVIGATION, 8.0)
    driven.until(lambda _: driven.goal.pose == STAND.pose, 2.0)
    return driven


@copied
def launching(config: HeatConfig | None = None) -> DrivenHeat:
    """Standing before the source."""
    driven = navigating(config)
    driven.arrive()
    driven.until_state(State.LAUNCHING, 1.0)
    return driven


@copied
def at_ramp(config: HeatConfig | None = None) -> DrivenHeat:
    """On its way to the foot of a ramp that it has met before."""
    driven = exploring(config)
    driven.mission.parts.ramps.ramps = (RAMP,)
    driven.arrive()
    driven.plan = HeatPlan(0, approaches=(APPROACH,))
    driven.until_state(State.ATTEMPTING_RAMP, 8.0)
    driven.until(lambda _: driven.goal.pose == APPROACH.pose, 3.0)
    return driven


@copied
def returning(config: HeatConfig | None = None) -> DrivenHeat:
    """On its way back, the ramp given up."""
    driven = exploring(config or HeatConfig(return_to_start=True))
    driven.mission.parts.agenda.ramp_given_up = True
    driven.arrive()
    driven.plan = HeatPlan(0)
    driven.until_state(State.RETURNING, 8.0)
    driven.ticks(1.0)
    return driven


def interrupted(driven: DrivenHeat) -> DrivenHeat:
    """The same mission, tilted."""
    driven.until_state(State.TILT_INTERRUPT, 1.0, pitch=RAMP_PITCH)
    return driven


def holding(driven: DrivenHeat) -> DrivenHeat:
    """The same mission, without scans."""
    driven.until_state(State.HOLD, 1.0, scans=())
    return driven


def paused(driven: DrivenHeat) -> DrivenHeat:
    assert driven.mission.request(Request.PAUSE)
    driven.tick()
    return driven


def failed() -> DrivenHeat:
    driven = DrivenHeat()
    driven.tick(grid=None)
    driven.time += 60.0
    driven.until_state(State.FAILED, 1.0, grid=None)
    return driven


def done() -> DrivenHeat:
    driven = exploring()
    driven.mission.request(Request.RETURN_HOME)
    driven.tick()
    return driven


REACH: dict[State, Callable[[], DrivenHeat]] = {
    State.INITIALIZING: DrivenHeat,
    State.EXPLORING: exploring,
    State.TILT_INTERRUPT: lambda: interrupted(exploring()),
    State.GOAL_NAVIGATION: navigating,
    State.LAUNCHING: launching,
    State.ATTEMPTING_RAMP: at_ramp,
    State.RETURNING: returning,
    State.DONE: done,
    State.PAUSED: lambda: paused(exploring()),
    State.FAILED: failed,
    State.HOLD: lambda: holding(exploring()),
}


def reach(state: State) -> DrivenHeat:
    """A mission in a state."""
    driven = REACH[state]()
    assert driven.state is state
    return driven
