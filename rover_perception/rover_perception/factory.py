"""The perception pipeline that the parameters name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rover_common.saved_state import Memory
from rover_common.types import CameraFrame, GridMap, PerceptionResult, Run
from rover_perception.baseline.perception import BaselinePerception
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception


class Pipeline(Protocol):
    """What the node and the loop without ROS need of a pipeline."""

    def process(self, frame: CameraFrame) -> PerceptionResult:
        """Add one frame to the map and the rocks; raises FrameError."""

    def world_map(self) -> GridMap:
        """The map in cells of `map_resolution`."""

    def navigation_map(self) -> GridMap:
        """The same map in cells of `evidence_resolution`."""

    def vision_image(self) -> NDArray[np.uint8] | None:
        """The newest image with what is seen in it; None where nothing can be."""

    def birdseye_image(self) -> NDArray[np.uint8] | None:
        """The same from above; None where nothing can be seen."""

    def memory(self) -> Callable[[], Memory]:
        """A copy of what it knows; the call makes of it what `resume` takes."""

    def resume(self, run: Run, memory: Memory) -> None:
        """Go on with a run as it was saved; what is none raises and changes nothing."""


def make_perception(config: PerceptionConfig) -> Pipeline:
    """The one that `recipe` names."""
    return BaselinePerception(config) if config.recipe == "baseline" else Perception(config)
