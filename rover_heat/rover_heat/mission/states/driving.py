"""What the states have in common in which the robot moves: trouble comes first."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection

from rover_decision.trouble import INPUTS, MOTION, Limits, Trouble, first_trouble
from rover_heat.config import HeatConfig
from rover_heat.inputs import APART, JUMP
from rover_heat.mission.chart import Event
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.tick import HeatBehavior, HeatTick

PLAN_PERIODS, PLAN_EXTRA = 2.0, 2.0  # periods, and [s], after which a plan is too old
# [s] of ticks without a word of it: with the one before, it stands within 0.5 s of its death.
NAVIGATOR_SILENT = 0.35
COMMON = MOTION | {Trouble.clock_apart, Trouble.navigator_lost}
PLANNED = COMMON | INPUTS - {Trouble.map_stale}


def limits_of(config: HeatConfig) -> Limits:
    """From where on it is trouble, for the detectors that all missions share."""
    return Limits(
        tilt=1.0,  # the monitor's share of what its rules allow
        gap=0.0,  # of the time that an input may be silent
        jump=JUMP,
        plan_age=PLAN_PERIODS / config.control_rate + PLAN_EXTRA,
        map_age=float("inf"),
        clock_error=APART,
        navigator_silent=NAVIGATOR_SILENT,
    )


class Driving(HeatBehavior):
    """Trouble, then the time, then what concerns the state itself."""

    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self._limits = limits_of(parts.config)

    def event(self, tick: HeatTick) -> Event | None:
        trouble = first_trouble(tick.health, self._limits, self._watched())
        if trouble is not None:
            return Event[trouble.name]
        return Event.finish if self._parts.agenda.time_is_up else self._own_event(tick)

    def _watched(self) -> Collection[Trouble]:
        return COMMON

    @abstractmethod
    def _own_event(self, tick: HeatTick) -> Event | None:
        """What else may happen in this state."""
