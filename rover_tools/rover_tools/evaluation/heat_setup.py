"""How a heat mission is run: its parameters, and the variant of the robot that they meet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory

from burger_simulator.options import BurgerOptions
from rover_heat.config import HeatConfig
from rover_heat.presets import load_preset

PRESETS = ("heat", "reference", "page")
# Variants of the robot by the names that users write, with the options of the simulator that make
# them.
VARIANTS = {
    "scan_rate": ("scan_rate",),
    "thermal_rate": ("thermal_rate",),
    "thermal_delay": ("thermal_delay",),
    "dead_sensor": ("thermal_dead",),
    "offset": ("thermal_offset_1", "thermal_offset_2"),
    "box": ("box_body",),
}
# The simulated robot's thermal sensors are mounted as the mission's parameters say.
MOUNTING = ("thermal_yaw_1", "thermal_yaw_2", "thermal_flip_1", "thermal_flip_2")


@dataclass(frozen=True)
class HeatSetup:
    """Parameters of the mission, options of the simulator, and a name for both."""

    label: str = "heat"
    config: HeatConfig = field(default_factory=HeatConfig)
    options: BurgerOptions = field(default_factory=BurgerOptions)

    @classmethod
    def of(
        cls,
        preset: str = "heat",
        file: Path | None = None,
        variant: Mapping[str, Any] | None = None,
        **parameters: Any,
    ) -> HeatSetup:
        """A preset, or a file of parameters instead; `parameters` are set over them.

        variant: what differs from the usual robot, by the names of VARIANTS. Raises PresetError.
        """
        config = replace(load_preset(file or preset_file(preset)), **parameters)
        variant = variant or {}
        words = [f"{name.replace('_', '-')}-{value:g}" for name, value in variant.items()]
        mounting = {name: getattr(config, name) for name in MOUNTING}
        options = BurgerOptions(**mounting, **options_of(variant))
        return cls("+".join([file.stem if file else preset, *words]), config, options)

    def settings(self) -> dict[str, Any]:
        """What differs from the defaults."""
        options = _changed(self.options)
        return _changed(self.config) | {k: v for k, v in options.items() if k not in MOUNTING}


def options_of(variant: Mapping[str, Any]) -> dict[str, Any]:
    """Options of the simulator by their names."""
    return {option: value for name, value in variant.items() for option in VARIANTS[name]}


def preset_file(name: str) -> Path:
    """The file of a preset that ships."""
    return Path(get_package_share_directory("rover_bringup")) / "config" / f"{name}.yaml"


def _changed(values: HeatConfig | BurgerOptions) -> dict[str, Any]:
    values_of = {each.name: (getattr(values, each.name), each.default) for each in fields(values)}
    return {name: value for name, (value, default) in values_of.items() if value != default}
