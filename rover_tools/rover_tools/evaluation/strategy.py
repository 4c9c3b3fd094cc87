"""Strategies by name: how to explore, and how to come home.

A classic is whole: with its name come its perception and its own way home.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from rover_common.errors import RoverError
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_perception.config import PerceptionConfig
from rover_tools.evaluation.parameters import read_parameters

DEFAULTS = DecisionConfig()
NO_TIME_LIMIT = 36000.0  # [s] the documents of the classics know none


class StrategyError(RoverError, ValueError):
    """A name that is no strategy's."""


@dataclass(frozen=True)
class Preset:
    """What comes with an explorer's name."""

    way_home: str = DEFAULTS.way_home
    decision: Mapping[str, Any] = field(default_factory=dict)
    perception: Mapping[str, Any] = field(default_factory=dict)
    knows_truth: bool = False  # measures what is mapped against the true map


BASELINE: dict[str, Any] = {"recipe": "baseline"}
# A maps every frame, and all of it: without the range and the tilt limit that B has.
UNLIMITED: dict[str, Any] = {"baseline_range": 30.0, "baseline_tilt": 1.6}
COUNTED: dict[str, Any] = {"nav_cell": 0.1, "time_limit": NO_TIME_LIMIT}  # in its cells
PRESETS = {
    "classic_a": Preset(
        "breadcrumbs",
        COUNTED | {"complete_at": 0.98, "complete_rule": "any"},
        BASELINE | UNLIMITED,
        knows_truth=True,
    ),
    "classic_b": Preset("bearing", COUNTED, BASELINE),
}


@dataclass(frozen=True)
class Strategy:
    """An explorer and a way home; written `explorer` if it is its own, or `explorer+way_home`."""

    explorer: str = DEFAULTS.explorer
    way_home: str = DEFAULTS.way_home
    # Whether what comes with the name is set too; a parameter file says all by itself.
    whole: bool = field(default=True, compare=False)

    @classmethod
    def parse(cls, text: str) -> Strategy:
        """Raises StrategyError, which says what there is."""
        explorer, plus, way_home = text.strip().partition("+")
        _check("explorer", explorer)
        return cls(explorer, preset_of(explorer).way_home).coming_home(way_home if plus else None)

    @classmethod
    def of_parameters(cls, path: Path) -> Strategy:
        """The one that a parameter file sets; raises ParametersError."""
        values = read_parameters(path)["decision_node"]
        return cls(
            str(values.get("explorer", DEFAULTS.explorer)),
            str(values.get("way_home", DEFAULTS.way_home)),
            whole=False,
        )

    def coming_home(self, way_home: str | None) -> Strategy:
        """With another way home, if one is given; raises StrategyError."""
        if way_home is None:
            return self
        _check("way_home", way_home)
        return replace(self, way_home=way_home)

    def __str__(self) -> str:
        default = self.way_home == preset_of(self.explorer).way_home
        return self.explorer if default else f"{self.explorer}+{self.way_home}"

    def parameters(self, truth: Path | None = None) -> dict[str, dict[str, Any]]:
        """Of the nodes, by their names; truth: picture of the map, for whom it is known to."""
        preset = preset_of(self.explorer) if self.whole else Preset()
        chosen = {"explorer": self.explorer, "way_home": self.way_home}
        if truth is not None and preset.knows_truth:
            chosen["truth"] = str(truth)
        return {
            "decision_node": chosen | dict(preset.decision),
            "perception_node": dict(preset.perception),
        }

    def config(self, truth: Path | None = None) -> DecisionConfig:
        """All other parameters at their defaults; truth: as for `parameters`."""
        return replace(DEFAULTS, **self.parameters(truth)["decision_node"])

    def perception(self) -> PerceptionConfig:
        """All other parameters at their defaults."""
        return PerceptionConfig(**self.parameters()["perception_node"])


def preset_of(explorer: str) -> Preset:
    """What comes with its name; nothing for most."""
    return PRESETS.get(explorer, Preset())


def choices(parameter: str) -> tuple[str, ...]:
    """The values that a parameter of the decision node can have."""
    (found_field,) = (each for each in fields(DecisionConfig) if each.name == parameter)
    found: tuple[str, ...] = found_field.metadata["parameter"].choices
    return found


def _check(parameter: str, value: str) -> None:
    found = choices(parameter)
    if value not in found:
        raise StrategyError(f"no {parameter} '{value}'; there are {', '.join(found)}")
