"""The frame that is explained, and those before it: of an image, a log or a recording in MCAP."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common import topics
from rover_common.camera import ROVER_CAMERA
from rover_common.errors import RoverError
from rover_common.geometry import Pose
from rover_common.grid import WORLD
from rover_common.ros.conversions import run_of
from rover_common.types import CameraFrame
from rover_recorder.conversions import message_of
from rover_recorder.reader import find_recording, open_recording
from rover_simulator.recordings.recording import LOG_NAME, RecordedFrame
from rover_tools.evaluation.recordings import load_log
from rover_tools.runner.recorded_run import FRAME_TYPES, FrameMessages, recorded_run

MOST_FRAMES = 500  # that are mapped: 20 s at 25 frames a second
MCAP = ".mcap"
LIVE_LAG = 1  # frames by which an image of the running graph is older than its pose

T = TypeVar("T")


class ExplainError(RoverError, ValueError):
    """There is no frame to explain."""


@dataclass(frozen=True)
class FrameChoice:
    """Which frame of a run: the last one unless a number or a time is given."""

    number: int | None = None  # from 0
    time: float | None = None  # [s] since the first frame

    def passed(self, number: int, time: float) -> bool:
        """Whether the frame is behind the chosen one."""
        return (self.number is not None and number > self.number) or (
            self.time is not None and time > self.time + 1e-6
        )


@dataclass(frozen=True)
class ExplainedFrames:
    """The frame that is explained comes last."""

    title: str
    frames: tuple[CameraFrame, ...]
    image_lag: int


def is_run(path: Path) -> bool:
    """Whether a path names many frames, and not one image."""
    return path.is_dir() or path.suffix == MCAP


def load_image(path: Path, pitch: float, roll: float) -> ExplainedFrames:
    """One image at a pitch and a roll [rad], as if taken at the start of the original's world.

    Raises ExplainError for what is no picture of the camera, and OSError.
    """
    image = _decoded(path.read_bytes(), path)
    pose = Pose(WORLD.start_x, WORLD.start_y, 0.0, pitch, roll)
    return ExplainedFrames(path.name, (CameraFrame(1, pose, image),), 0)


def load_run(path: Path, choice: FrameChoice) -> ExplainedFrames:
    """A frame of a run: a folder of the Unity simulator's kind, or a recording in MCAP.

    Raises ExplainError, or the RecordingError of either kind.
    """
    if path.is_dir() and (path / LOG_NAME).is_file():
        return _of_log(path, choice)
    if find_recording(path) is None:
        raise ExplainError(f"{path} holds no recording: neither {LOG_NAME} nor an {MCAP} file")
    return _of_mcap(path, choice)


def _of_log(path: Path, choice: FrameChoice) -> ExplainedFrames:
    found = ((frame.time, frame) for frame in load_log(path).frames)
    chosen, title = _chosen(found, choice, path)
    return ExplainedFrames(title, tuple(_frame_of_log(*each) for each in chosen), 0)


def _frame_of_log(time: float, frame: RecordedFrame) -> CameraFrame:
    image = _decoded(frame.image_path.read_bytes(), frame.image_path)
    return CameraFrame(1 + round(time * 1e9), frame.pose, image)


def _of_mcap(path: Path, choice: FrameChoice) -> ExplainedFrames:
    frames = recorded_run(open_recording(path)).frames()
    chosen, title = _chosen(_with_times(frames), choice, path)
    return ExplainedFrames(title, tuple(_frame_of_mcap(each) for _, each in chosen), LIVE_LAG)


def _with_times(frames: Iterable[FrameMessages]) -> Iterable[tuple[float, FrameMessages]]:
    start: int | None = None
    for frame in frames:
        start = frame.stamp if start is None else start
        yield (frame.stamp - start) * 1e-9, frame


def _frame_of_mcap(frame: FrameMessages) -> CameraFrame:
    status = message_of(FRAME_TYPES[topics.STATUS], frame.status)
    image = _decoded(frame.jpeg, f"the image at {frame.stamp} ns")
    return CameraFrame(frame.stamp, frame.pose, image, run_of(status))


def _chosen(
    frames: Iterable[tuple[float, T]], choice: FrameChoice, path: Path
) -> tuple[list[tuple[float, T]], str]:
    """The chosen frame and those before it with their times [s], and a title."""
    found: deque[tuple[float, T]] = deque(maxlen=MOST_FRAMES)
    number, last = -1, -math.inf
    for time, frame in frames:
        if choice.passed(number + 1, time):
            break
        number, last = number + 1, time
        found.append((time, frame))
    else:
        if choice.number is not None and number < choice.number:
            raise ExplainError(f"{path} has no frame {choice.number}: it holds 0 to {number}")
        if choice.time is not None and last < choice.time:
            raise ExplainError(f"{path} ends after {last:.2f} s, before {choice.time:g} s")
    if not found:
        raise ExplainError(f"{path} holds no whole frame")
    return list(found), f"{path.name}, frame {number} at {last:.2f} s"


def _decoded(content: bytes, name: Path | str) -> NDArray[np.uint8]:
    """RGB (height, width, 3) of the camera's size."""
    data = np.frombuffer(content, np.uint8)
    image = cv2.imdecode(data, cv2.IMREAD_COLOR) if data.size else None
    if image is None:
        raise ExplainError(f"{name} is no picture that can be read")
    height, width = image.shape[:2]
    if (width, height) != (ROVER_CAMERA.width, ROVER_CAMERA.height):
        raise ExplainError(
            f"{name} is {width} x {height}; the camera's pictures are "
            f"{ROVER_CAMERA.width} x {ROVER_CAMERA.height}"
        )
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), np.uint8)
