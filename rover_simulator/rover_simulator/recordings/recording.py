"""Read a recorded run of the simulator: robot_log.csv and a folder of JPEG frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from rover_common.csv_table import CellError, Row, TableError, read_table
from rover_common.errors import RoverError
from rover_common.geometry import Pose, wrap_angle
from rover_simulator.recordings.clock import FrameClock
from rover_simulator.recordings.motion import contradicts_yaw, reachable
from rover_simulator.recordings.pictures import FOLDER, find_picture
from rover_simulator.recordings.skips import Cause, Skip, UnusableError, by_cause, skips_in_words

LOG_NAME = "robot_log.csv"
COLUMNS = (
    "path", "steerangle", "throttle", "brake", "speed",
    "x_position", "y_position", "pitch", "yaw", "roll",
)  # fmt: skip

YawConvention = Literal["ccw-from-east", "cw-from-north"]
OTHER_CONVENTION: dict[YawConvention, YawConvention] = {
    "ccw-from-east": "cw-from-north",
    "cw-from-north": "ccw-from-east",
}


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
    line: int = 0  # of the log, from 1


@dataclass(frozen=True)
class Recording:
    frames: tuple[RecordedFrame, ...]
    skips: tuple[Skip, ...] = ()  # rows that cannot be used, in their order
    yaw_convention: YawConvention = "ccw-from-east"

    def remarks(self) -> list[str]:
        """What its user should know: what was skipped and why, and whether its yaw can be right."""
        lines = skips_in_words(self.skips, len(self.frames) + len(self.skips))
        poses, speeds = zip(*((frame.pose, frame.speed) for frame in self.frames), strict=True)
        contradicted, other_fits = contradicts_yaw(poses, speeds)
        if contradicted:
            other = OTHER_CONVENTION[self.yaw_convention]
            advice = "it fits --yaw-convention" if other_fits else "nor does it fit"
            lines.append(
                f"the motion contradicts the yaw as {self.yaw_convention}; {advice} {other}"
            )
        return lines


def read_recording(folder: Path, yaw_convention: YawConvention = "ccw-from-east") -> Recording:
    """Read a run; rows that cannot be used are skipped, and their causes kept.

    A row needs finite numbers, a picture that the bridge takes, and a position that the rover can
    have reached. Of a row with more cells than its header, the last nine are the numbers. Raises
    RecordingError when there is no log, or no usable row in it.
    """
    log = folder / LOG_NAME
    try:
        rows = read_table(log, COLUMNS, text_column="path", needs_header=False)
    except OSError as error:
        raise RecordingError(f"{log}: {error.strerror or error}") from error
    except TableError as error:
        raise RecordingError(str(error)) from error
    skips: list[Skip] = []
    frames = list(_frames(rows, folder, yaw_convention, skips))
    if not frames:
        raise RecordingError(_no_frame(log, rows, skips))
    usable = reachable([frame.pose for frame in frames], [frame.time for frame in frames])
    for frame, is_usable in zip(frames, usable, strict=True):
        if not is_usable:
            place = f"x = {frame.pose.x:g}, y = {frame.pose.y:g}"
            skips.append(Skip(frame.line, Cause.JUMP, place))
    kept = tuple(frame for frame, is_usable in zip(frames, usable, strict=True) if is_usable)
    return Recording(kept, tuple(sorted(skips, key=lambda skip: skip.line)), yaw_convention)


def _frames(
    rows: list[Row], folder: Path, yaw_convention: YawConvention, skips: list[Skip]
) -> Iterator[RecordedFrame]:
    clock = FrameClock()
    for row in rows:
        try:
            yield _frame(row, folder, yaw_convention, clock)
        except UnusableError as error:
            skips.append(Skip(row.line, error.cause, error.detail))


def _frame(
    row: Row, folder: Path, yaw_convention: YawConvention, clock: FrameClock
) -> RecordedFrame:
    try:
        steer_deg, throttle, brake, speed, x, y, pitch_deg, yaw_deg, roll_deg = (
            row.number(name) for name in COLUMNS[1:]
        )
        path = row.text("path")
    except CellError as error:
        raise UnusableError(Cause.CELLS, str(error).partition(": ")[2]) from error
    image_path = find_picture(path, folder)
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
    return RecordedFrame(
        image_path, time, pose, speed, throttle, brake, math.radians(steer_deg), row.line
    )


def _no_frame(log: Path, rows: list[Row], skips: list[Skip]) -> str:
    """Why there is none, with the remedy for the commonest cause."""
    if not rows:
        return f"{log}: no row below its header"
    causes = by_cause(skips)
    cause, some = next(iter(causes.items()))
    if cause is Cause.NO_PICTURE and len(some) == len(rows):
        places = f"{log.parent / FOLDER} or {log.parent}"
        return f"none of the {len(rows)} pictures was found in {places}; {cause.remedy}"
    found = "; ".join(
        f"{each.text}: {len(skipped)} (line {skipped[0].line}: {skipped[0].detail})"
        for each, skipped in causes.items()
    )
    return f"{log}: no usable row among {len(rows)}; {found}; {cause.remedy}"
