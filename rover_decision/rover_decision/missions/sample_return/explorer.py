"""An explorer: what the parameter of this name chooses."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.drivers import Drivers
from rover_decision.missions.sample_return.explorer_names import EXPLORERS
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.planned import planned
from rover_decision.missions.sample_return.solution import Solution
from rover_navigation.scale import Scale
from rover_navigation.selection import NearestStop, Selection, WholeTour

MakeSolution = Callable[[DecisionConfig, Parts, Drivers], Solution]


@dataclass(frozen=True)
class Preset:
    """Parameters that come with a strategy that is chosen by its name, unless a file sets them."""

    way_home: str = DecisionConfig().way_home
    decision: Mapping[str, Any] = field(default_factory=dict)
    perception: Mapping[str, Any] = field(default_factory=dict)
    knows_truth: bool = False  # measures what is mapped against the true map


@dataclass(frozen=True)
class Explorer:
    """Plans and states that explore; each default is that of `tour`."""

    selection: Callable[[Scale], Selection] = WholeTour  # which stop of the plans comes first
    solution: MakeSolution = planned  # the states that drive; explorers may share one
    preset: Preset = Preset()


TOUR = Explorer()
FRONTIER = Explorer(NearestStop)


def explorer_of(name: str) -> Explorer:
    """The one of this name; raises PartError."""
    return EXPLORERS.load(name, Explorer)
