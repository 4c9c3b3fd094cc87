"""Parameters of the recorder node."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import parameter


@dataclass(frozen=True)
class RecorderConfig:
    folder: str = parameter(
        "", "folder to record into; empty for a new one below results, named by the time"
    )
    leave_out: str = parameter("nav_polar", "topics that are not recorded, separated by spaces")
    mission: str = parameter(
        "rover",
        "whose topics have to be there before it is ready: rover, heat, or drive for a rover"
        " without a mission",
        choices=("rover", "heat", "drive"),
    )
