"""A mission over time, of either robot: one point of its track a second, and changes of state."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any, Generic, Protocol, TypeVar

from rover_common.geometry import Pose

PERIOD = 1.0  # [s] between two points of the track


class Moment(Protocol):
    """The robot and its mission at one frame."""

    @property
    def time(self) -> float:
        """[s] since the mission's first frame."""

    @property
    def pose(self) -> Pose: ...

    @property
    def state(self) -> str: ...

    @property
    def reason(self) -> str: ...


class Point(Protocol):
    """One row of a track; a dataclass."""

    @property
    def time(self) -> float:
        """[s] since the mission's first frame."""

    @property
    def x(self) -> float:
        """[m] map frame."""

    @property
    def y(self) -> float:
        """[m]"""

    @property
    def state(self) -> str: ...


@dataclass(frozen=True)
class StateChange:
    """The mission enters a state."""

    time: float  # [s]
    state: str
    reason: str
    x: float  # [m]
    y: float  # [m]


P = TypeVar("P")


class TrackBuilder(Generic[P]):
    """Takes every frame of a mission; makes a point of the first one in each period."""

    def __init__(self, period: float = PERIOD) -> None:
        """period [s]: between two points of the track."""
        self._period = period
        self._track: list[tuple[float, float, P]] = []  # with its time [s] and tilt [rad]
        self._changes: list[StateChange] = []
        self._next = -math.inf  # [s] when a point is due
        self._tilt = 0.0
        self._last: tuple[float, Callable[[float], P]] | None = None

    def add(self, moment: Moment, tilt: float, point: Callable[[float], P]) -> None:
        """Add the next frame, at which the body is tilted so much [rad].

        `point` makes a point of it and of the largest tilt since the point before; it is called
        where one is due.
        """
        self._tilt = max(self._tilt, tilt)
        if not self._changes or self._changes[-1].state != moment.state:
            place = moment.pose
            change = StateChange(moment.time, moment.state, moment.reason, place.x, place.y)
            self._changes.append(change)
        self._last = moment.time, point
        if moment.time >= self._next - 1e-6:
            self._next = self._period * (math.floor(moment.time / self._period + 1e-6) + 1)
            self._add_point()

    def end(self, point: Callable[[float], P] | None = None) -> None:
        """The track ends with the last frame; `point` makes its point instead."""
        if self._last is None:
            return
        time, made = self._last
        if self._track and self._track[-1][0] == time:
            self._tilt = self._track.pop()[1]
        self._last = time, point or made
        self._add_point()

    @property
    def track(self) -> tuple[P, ...]:
        return tuple(point for _, _, point in self._track)

    @property
    def changes(self) -> tuple[StateChange, ...]:
        return tuple(self._changes)

    def _add_point(self) -> None:
        assert self._last is not None
        time, point = self._last
        self._track.append((time, self._tilt, point(self._tilt)))
        self._tilt = 0.0


def tilt_of(pose: Pose) -> float:
    """The angle [rad] between the body's z axis and the vertical."""
    return math.acos(min(1.0, math.cos(pose.roll) * math.cos(pose.pitch)))


def csv_of(kind: Any, track: Sequence[Any]) -> str:
    """A file of all points, of one kind; a value that is not known is an empty field."""
    file = io.StringIO()
    writer = csv.DictWriter(file, [each.name for each in fields(kind)], lineterminator="\n")
    writer.writeheader()
    writer.writerows(asdict(point) for point in track)
    return file.getvalue()
