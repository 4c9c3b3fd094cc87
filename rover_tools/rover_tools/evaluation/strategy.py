"""Strategies by name: how to explore, how to come home, and how to see.

An explorer may be whole, as a classic is: with its name come its perception and its own way home.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from rover_common.errors import RoverError
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.explorer import Preset, explorer_of
from rover_perception.config import PerceptionConfig
from rover_perception.factory import recipe_of
from rover_tools.evaluation.parameters import read_parameters

DEFAULTS = DecisionConfig()
SEEN_BY = PerceptionConfig().recipe


class StrategyError(RoverError, ValueError):
    """A name that is no strategy's."""


@dataclass(frozen=True)
class Strategy:
    """Written `explorer`, and `+way_home` or `@recipe` after it where they are not its own."""

    explorer: str = DEFAULTS.explorer
    way_home: str = DEFAULTS.way_home
    recipe: str = SEEN_BY
    # Whether what comes with the name is set too; a parameter file says all by itself.
    whole: bool = field(default=True, compare=False)

    @classmethod
    def parse(cls, text: str) -> Strategy:
        """Raises StrategyError, which says what there is, or PartError."""
        driven, at, recipe = text.strip().partition("@")
        explorer, plus, way_home = driven.partition("+")
        own = cls.of_explorer(explorer)
        seeing = own.seeing_by(recipe if at else None)
        return seeing.coming_home(way_home if plus else None)

    @classmethod
    def of_explorer(cls, name: str) -> Strategy:
        """With its own way home, and its own perception; raises StrategyError or PartError."""
        _check(DecisionConfig, "explorer", name)
        preset = explorer_of(name).preset
        return cls(name, preset.way_home, preset.perception.get("recipe", SEEN_BY))

    @classmethod
    def of_parameters(cls, path: Path) -> Strategy:
        """The one that a parameter file sets; raises ParametersError."""
        values = read_parameters(path)
        decision = values["decision_node"]
        return cls(
            str(decision.get("explorer", DEFAULTS.explorer)),
            str(decision.get("way_home", DEFAULTS.way_home)),
            str(values["perception_node"].get("recipe", SEEN_BY)),
            whole=False,
        )

    def coming_home(self, way_home: str | None) -> Strategy:
        """With another way home, if one is given; raises StrategyError."""
        if way_home is None:
            return self
        _check(DecisionConfig, "way_home", way_home)
        return replace(self, way_home=way_home)

    def seeing_by(self, recipe: str | None) -> Strategy:
        """With another recipe of perception, if one is given; raises StrategyError or PartError."""
        if recipe is None:
            return self
        _check(PerceptionConfig, "recipe", recipe)
        recipe_of(recipe)
        return replace(self, recipe=recipe)

    def __str__(self) -> str:
        own = Strategy.of_explorer(self.explorer)
        way_home = "" if self.way_home == own.way_home else f"+{self.way_home}"
        recipe = "" if self.recipe == own.recipe else f"@{self.recipe}"
        return self.explorer + way_home + recipe

    def parameters(self, truth: Path | None = None) -> dict[str, dict[str, Any]]:
        """Of the nodes, by their names; truth: picture of the map, for whom it is known to."""
        preset = explorer_of(self.explorer).preset if self.whole else Preset()
        chosen = {"explorer": self.explorer, "way_home": self.way_home}
        if truth is not None and preset.knows_truth:
            chosen["truth"] = str(truth)
        return {
            "decision_node": chosen | dict(preset.decision),
            "perception_node": dict(preset.perception) | {"recipe": self.recipe},
        }

    def config(self, truth: Path | None = None) -> DecisionConfig:
        """All other parameters at their defaults; truth: as for `parameters`."""
        return replace(DEFAULTS, **self.parameters(truth)["decision_node"])

    def perception(self) -> PerceptionConfig:
        """All other parameters at their defaults."""
        return PerceptionConfig(**self.parameters()["perception_node"])


def choices(config: type, parameter: str) -> Collection[str]:
    """The values that a parameter of a node's configuration can have."""
    (found_field,) = (each for each in fields(config) if each.name == parameter)
    found: Collection[str] = found_field.metadata["parameter"].choices
    return found


def _check(config: type, parameter: str, value: str) -> None:
    found = choices(config, parameter)
    if value not in found:
        raise StrategyError(f"no {parameter} '{value}'; there are {', '.join(found)}")
