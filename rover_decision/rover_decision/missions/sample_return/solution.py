"""A solution of the mission: a chart, an object for each of its states, and what they share."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from statemachine import StateChart

from rover_common.types import Command
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext


def _nothing(tick: TickContext, what: object) -> None:
    """Nothing is remembered."""


@dataclass(frozen=True)
class Solution:
    """The mission runs it: it observes a frame, handles the state's event, and does its action."""

    chart: type[StateChart]
    states: Mapping[State, StateBehavior]
    observe: Callable[[TickContext, State], None] = _nothing  # a frame, before it is decided on
    commanded: Callable[[TickContext, Command], None] = _nothing  # what was decided
    # Time goes into a rock in these, which is given up after its deadline.
    approaching: frozenset[State] = frozenset()
    breadcrumb_path: bool = True  # home along that of the plans; a classic has its own
