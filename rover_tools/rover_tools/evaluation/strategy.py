"""Strategies by name: how to explore, and how to come home."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from pathlib import Path

import yaml

from rover_common.errors import RoverError
from rover_decision.missions.sample_return.config import DecisionConfig

DEFAULTS = DecisionConfig()


class StrategyError(RoverError, ValueError):
    """A name that is no strategy's."""


class ParametersError(RoverError, ValueError):
    """A parameter file that cannot be read."""


@dataclass(frozen=True)
class Strategy:
    """Two parameters of the decision node; written `explorer`, or `explorer+way_home`."""

    explorer: str = DEFAULTS.explorer
    way_home: str = DEFAULTS.way_home

    @classmethod
    def parse(cls, text: str) -> Strategy:
        """Raises StrategyError, which says what there is."""
        explorer, plus, way_home = text.strip().partition("+")
        _check("explorer", explorer)
        return cls(explorer).coming_home(way_home if plus else None)

    @classmethod
    def of_parameters(cls, path: Path) -> Strategy:
        """The one that a parameter file sets; raises ParametersError."""
        try:
            sections = yaml.safe_load(path.read_text()) or {}
            values: dict[str, object] = {}
            for node, section in sections.items():
                if node.endswith("decision_node") or node == "/**":
                    values |= section["ros__parameters"]
        except (AttributeError, KeyError, TypeError, ValueError, yaml.YAMLError) as error:
            reason = " ".join(str(error).split())  # PyYAML writes several lines
            raise ParametersError(f"{path}: not a parameter file ({reason})") from error
        return cls(
            str(values.get("explorer", DEFAULTS.explorer)),
            str(values.get("way_home", DEFAULTS.way_home)),
        )

    def coming_home(self, way_home: str | None) -> Strategy:
        """With another way home, if one is given; raises StrategyError."""
        if way_home is None:
            return self
        _check("way_home", way_home)
        return replace(self, way_home=way_home)

    def __str__(self) -> str:
        default = self.way_home == DEFAULTS.way_home
        return self.explorer if default else f"{self.explorer}+{self.way_home}"

    def parameters(self) -> dict[str, object]:
        """Of the decision node."""
        return {"explorer": self.explorer, "way_home": self.way_home}

    def config(self) -> DecisionConfig:
        """All other parameters at their defaults."""
        return replace(DEFAULTS, explorer=self.explorer, way_home=self.way_home)


def choices(parameter: str) -> tuple[str, ...]:
    """The values that a parameter of the decision node can have."""
    (field,) = (field for field in fields(DecisionConfig) if field.name == parameter)
    found: tuple[str, ...] = field.metadata["parameter"].choices
    return found


def _check(parameter: str, value: str) -> None:
    found = choices(parameter)
    if value not in found:
        raise StrategyError(f"no {parameter} '{value}'; there are {', '.join(found)}")
