"""Parameters of heat_node: the mission's own, and how it is connected."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import STATE_DIR, parameter
from rover_heat.config import HeatConfig


@dataclass(frozen=True)
class HeatNodeConfig(HeatConfig):
    state_dir: str = parameter(*STATE_DIR)
    lockstep: bool = parameter(
        False, "decide on every sensor_tick instead of 20 times a second, and answer it"
    )
