"""Read a recorded run of the simulator: robot_log.csv and a folder of JPEG frames."""

from __future__ import annotations

import csv
import math
import re
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path, PureWindowsPath
from typing import Literal

from rover_common.errors import RoverError
from rover_common.geometry import Pose, wrap_angle

LOG_NAME = "robot_log.csv"
COLUMNS = (
    "path", "steerangle", "throttle", "brake", "speed",
    "x_position", "y_position", "pitch", "yaw", "roll",
)  # fmt: skip

# robocam_2017_05_02_11_16_21_421.jpg: date, time, milliseconds
STAMPED_NAME = re.compile(r"\d{4}(_\d\d){5}_\d{3}")
NOMINAL_PERIOD = 0.04  # [s] between frames whose names carry no time

YawConvention = Literal["ccw-from-east", "cw-from-north"]


class RecordingError(RoverError, ValueError):
    """The folder holds no recorded run that can be played."""


@dataclass(frozen=True)
class RecordedFrame:
    image_path: Path
    time: float  # [s] since the first frame, never decreasing
    pose: Pose
    speed: float  # [m/s] forward positive
    throttle: float
    brake: float
    steering_angle: float  # [rad] left positive


@dataclass(frozen=True)
class Recording:
    frames: tuple[RecordedFrame, ...]
    skipped: int  # rows that could not be used


def read_recording(folder: Path, yaw_convention: YawConvention = "ccw-from-east") -> Recording:
    """Read a run; rows with missing, non-finite or non-numeric values or no image are skipped.

    The separator is `;` or `,`. Only the file name of a row's path counts: recordings carry the
    paths of the machine that made them, Windows ones among them. Raises RecordingError when there
    is no log, or no usable row in it.
    """
    log = folder / LOG_NAME
    try:
        lines = log.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    except OSError as error:
        raise RecordingError(f"{log}: {error.strerror or error}") from error
    rows = _rows([line.replace("\0", "") for line in lines if line.strip()])
    clock = _Clock()
    frames = []
    for row in rows:
        frame = _frame(row, folder, yaw_convention, clock)
        if frame is not None:
            frames.append(frame)
    if not frames:
        raise RecordingError(f"{log}: no usable row among {len(rows)}")
    return Recording(tuple(frames), len(rows) - len(frames))


def _rows(lines: list[str]) -> list[dict[str, str]]:
    """The data rows by lower-case column name; a log without a header has the usual order."""
    if not lines:
        return []
    separator = ";" if lines[0].count(";") >= lines[0].count(",") else ","
    table = list(csv.reader(lines, delimiter=separator))
    names = [name.strip().lower() for name in table[0]]
    if set(COLUMNS) <= set(names):
        table = table[1:]
    else:
        names = list(COLUMNS)
    decimal = str.maketrans(",", ".") if separator == ";" else {}
    return [
        {name: cell.strip() if name == "path" else cell.strip().translate(decimal)
         for name, cell in zip(names, row, strict=False)}
        for row in table
    ]  # fmt: skip


def _frame(
    row: dict[str, str], folder: Path, yaw_convention: YawConvention, clock: _Clock
) -> RecordedFrame | None:
    try:
        steer_deg, throttle, brake, speed, x, y, pitch_deg, yaw_deg, roll_deg = (
            _finite(row[name]) for name in COLUMNS[1:]
        )
    except (KeyError, ValueError):
        return None
    image_path = _find_image(row["path"], folder)
    if image_path is None:
        return None
    if yaw_convention == "cw-from-north":
        yaw_deg = 90.0 - yaw_deg
    pose = Pose(
        x,
        y,
        yaw=wrap_angle(math.radians(yaw_deg)),
        pitch=wrap_angle(math.radians(pitch_deg)),
        roll=-wrap_angle(math.radians(roll_deg)),  # the simulator's is positive right side up
    )
    time = clock.read(image_path.name)
    return RecordedFrame(image_path, time, pose, speed, throttle, brake, math.radians(steer_deg))


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def _find_image(path: str, folder: Path) -> Path | None:
    name = PureWindowsPath(path).name  # splits at both kinds of slash
    if not name:
        return None
    candidates = (folder / "IMG" / name, folder / name)
    return next((candidate for candidate in candidates if candidate.is_file()), None)


class _Clock:
    """Times of the frames [s] from their names, or at the nominal period without them."""

    def __init__(self) -> None:
        self._start: datetime | None = None
        self._last = -NOMINAL_PERIOD

    def read(self, name: str) -> float:
        time = self._last + NOMINAL_PERIOD
        match = STAMPED_NAME.search(name)
        if match:
            try:
                moment = datetime.strptime(match[0], "%Y_%m_%d_%H_%M_%S_%f")
            except ValueError:
                moment = None
            if moment is not None:
                self._start = self._start or moment
                time = (moment - self._start).total_seconds()
        self._last = max(self._last, time, 0.0)
        return self._last
