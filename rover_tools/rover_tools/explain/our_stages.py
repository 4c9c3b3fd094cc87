"""The stages of perception on one frame: what each gave, and what it is called in the code."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from rover_common.errors import RoverError
from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.types import CameraFrame, GridMap, PerceptionResult
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import Segmentation
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameError
from rover_perception.mapping.evidence import EvidenceGrid
from rover_perception.mapping.field_of_view import FieldOfView
from rover_perception.perception import Perception
from rover_perception.tracking.rock_detection import RockSightings
from rover_tools.explain.frames import ExplainedFrames
from rover_tools.explain.naming import name_of

P = ParamSpec("P")
T = TypeVar("T")


class NoGroundError(RoverError, ValueError):
    """The rover lies on its side: the image shows no ground that could be explained."""


class StageKeeper:
    """A stage runner that keeps what each stage of the newest frame gave, and its name."""

    def __init__(self) -> None:
        self.values: dict[str, Any] = {}
        self.names: dict[str, str] = {}

    def __call__(self, name: str, stage: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> T:
        value = stage(*args, **kwargs)
        self.values[name] = value
        self.names[name] = name_of(stage)
        return value


@dataclass(frozen=True)
class OurStages:
    """One frame; points are (n,) [m] in the level frame."""

    frames: tuple[CameraFrame, ...]  # those mapped, at the poses of their images; this one last
    projection: GroundProjection
    field_of_view: FieldOfView
    segmentation: Segmentation
    sightings: RockSightings
    evidence: EvidenceGrid  # of this frame alone
    grid: GridMap  # of all frames
    result: PerceptionResult
    names: dict[str, str]  # of the stages' functions, by the name that the pipeline gives them

    @property
    def image(self) -> NDArray[np.uint8]:
        """(height, width, 3) RGB"""
        return self.frames[-1].image

    @property
    def pose(self) -> Pose:
        """At which the image was taken."""
        return self.frames[-1].pose


def run_our_stages(source: ExplainedFrames) -> OurStages:
    """Map all frames, and keep the stages of the last one. Raises FrameError, NoGroundError."""
    config = PerceptionConfig(image_lag=source.image_lag)
    keeper = StageKeeper()
    core = Perception(config, keeper)
    frames = []
    for frame in source.frames[:-1]:
        with suppress(FrameError):
            core.process(frame)
            frames.append(replace(frame, pose=keeper.values["validation"]))
    result = core.process(source.frames[-1])
    frames.append(replace(source.frames[-1], pose=keeper.values["validation"]))
    segmentation, values = core.segmentation, keeper.values
    if segmentation is None:
        raise NoGroundError(f"{source.title}: the rover lies on its side, no ground is in view")
    pose, projection = values["validation"], values["projection"]
    field_of_view = FieldOfView(GridGeometry.of_world(config.evidence_resolution), config.max_range)
    alone = EvidenceGrid(field_of_view)
    alone.add(projection, segmentation.columns, pose)
    return OurStages(
        tuple(frames), projection, field_of_view, segmentation,
        values["rock_detection"], alone, core.world_map(),
        result, keeper.names,
    )  # fmt: skip
