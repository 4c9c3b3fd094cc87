"""Parameters of the perception node."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import STATE_DIR, parameter
from rover_common.errors import RoverError
from rover_common.grid import WORLD
from rover_perception.recipe_names import RECIPES


class ResolutionError(RoverError, ValueError):
    """Resolutions of which one does not divide the other."""


@dataclass(frozen=True)
class PerceptionConfig:
    """The node's parameters; raises ResolutionError for grids that do not fit into each other."""

    map_resolution: float = parameter(
        1.0, "[m] cell of the published world map", minimum=0.25, maximum=5.0
    )
    evidence_resolution: float = parameter(
        0.25,
        "[m] cell of the navigation map and of the evidence; divides the map's",
        minimum=0.05,
        maximum=1.0,
    )
    max_range: float = parameter(
        16.0,
        "[m] ground beyond is not mapped: a row of pixels there is 10 m long",
        minimum=2.0,
        maximum=30.0,
    )
    image_lag: int = parameter(
        1,
        "frames by which the image is older than the pose; 0 for recordings",
        minimum=0,
        maximum=2,
    )
    map_period: float = parameter(
        0.25, "[s] of frame time between two world maps", minimum=0.0, maximum=60.0
    )
    vision_period: float = parameter(
        0.2,
        "[s] of frame time between two vision images, and between two bird's-eye images",
        minimum=0.0,
        maximum=60.0,
        settable=True,
    )
    recipe: str = parameter(
        "exact",
        "how images become a map: exact, baseline as published programs do it, or one of an"
        " installed package",
        choices=RECIPES,
    )
    baseline_range: float = parameter(
        5.0, "[m] ground beyond is not mapped by the baseline", minimum=1.0, maximum=30.0
    )
    baseline_tilt: float = parameter(
        0.012217,
        "[rad] pitch or roll beyond which a frame is not mapped by the baseline",
        minimum=0.001,
        maximum=1.6,
    )
    state_dir: str = parameter(*STATE_DIR)

    def __post_init__(self) -> None:
        _check_divides(self.evidence_resolution, self.map_resolution, "map_resolution")
        _check_divides(self.evidence_resolution, WORLD.size, "the world's size")


def _check_divides(resolution: float, length: float, name: str) -> None:
    """Both in [m]."""
    count = length / resolution
    if abs(count - round(count)) > 1e-6 * count:
        raise ResolutionError(f"evidence_resolution {resolution} does not divide {name}, {length}")
