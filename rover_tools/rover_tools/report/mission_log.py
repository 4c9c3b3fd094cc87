"""The rover's mission over time: one point of the track a second, and every change of state."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rover_common.geometry import Pose
from rover_common.map_encoding import navigable_cells
from rover_common.types import GridMap, RockTrack
from rover_tools.evaluation.results import Result, Truth
from rover_tools.evaluation.scoring import score_map
from rover_tools.report.track import PERIOD, StateChange, TrackBuilder, csv_of, tilt_of


@dataclass(frozen=True)
class Moment:
    """The rover and its mission at one frame."""

    time: float  # [s] since the mission's first frame
    pose: Pose
    speed: float  # [m/s] forward positive
    state: str
    reason: str
    samples: int  # collected so far
    home_distance: float  # [m] straight line to the start
    distance: float  # [m] driven
    explored: float  # 0..1 of the reachable ground, as the rover estimates it


@dataclass(frozen=True)
class TrackPoint:
    """One row of track.csv."""

    time: float  # [s] since the mission's first frame
    x: float  # [m] map frame
    y: float  # [m]
    yaw: float  # [rad]
    roll: float  # [rad]
    pitch: float  # [rad]
    tilt: float  # [rad] of the body against the vertical, the largest since the row before
    speed: float  # [m/s] forward positive
    state: str
    samples: int  # collected so far
    home_distance: float  # [m]
    distance: float  # [m] driven
    explored: float  # [%] of the reachable ground, as the rover estimates it
    mapped_area: float | None  # [m^2] navigable ground on the map
    percent_mapped: float | None  # [%] of the true ground, where a truth is known
    fidelity: float | None  # [%]


@dataclass(frozen=True)
class MissionLog:
    """All that a mission's report shows."""

    title: str
    track: tuple[TrackPoint, ...]
    changes: tuple[StateChange, ...]
    grid: GridMap | None  # the last map
    rocks: tuple[RockTrack, ...]
    truth: Truth
    result: Result


class LogBuilder:
    """Takes every frame of a mission, keeps what its log needs."""

    def __init__(self, truth: Truth, period: float = PERIOD) -> None:
        """period [s]: between two points of the track."""
        self._truth = truth
        self._builder: TrackBuilder[TrackPoint] = TrackBuilder(period)
        self._moment: Moment | None = None  # the last

    def add(self, moment: Moment, grid: Callable[[], GridMap | None]) -> None:
        """Add the next frame; `grid` gives the world map and is called only for a point."""
        self._moment = moment
        self._builder.add(
            moment,
            tilt_of(moment.pose),
            lambda tilt: _point_of(moment, tilt, grid(), self._truth),
        )

    def log(
        self, title: str, grid: GridMap | None, rocks: tuple[RockTrack, ...], result: Result
    ) -> MissionLog:
        """The whole log; its track ends with the last frame and the last map."""
        moment, builder = self._moment, self._builder
        if moment is not None:
            builder.end(lambda tilt: _point_of(moment, tilt, grid, self._truth))
        return MissionLog(title, builder.track, builder.changes, grid, rocks, self._truth, result)


def track_csv(track: Sequence[TrackPoint]) -> str:
    """The content of track.csv; a value that is not known is an empty field."""
    return csv_of(TrackPoint, track)


def _point_of(moment: Moment, tilt: float, grid: GridMap | None, truth: Truth) -> TrackPoint:
    area = mapped = fidelity = None
    if grid is not None:
        navigable = navigable_cells(grid.cells)
        area = float(navigable.sum()) * grid.resolution**2
        if truth.navigable is not None:
            scores = score_map(navigable, truth.navigable)
            mapped, fidelity = round(scores.percent_mapped, 2), round(scores.fidelity, 2)
    pose = moment.pose
    return TrackPoint(
        time=round(moment.time, 3),
        x=round(pose.x, 3),
        y=round(pose.y, 3),
        yaw=round(pose.yaw, 4),
        roll=round(pose.roll, 4),
        pitch=round(pose.pitch, 4),
        tilt=round(tilt, 4),
        speed=round(moment.speed, 3),
        state=moment.state,
        samples=moment.samples,
        home_distance=round(moment.home_distance, 2),
        distance=round(moment.distance, 2),
        explored=round(100.0 * moment.explored, 1),
        mapped_area=area,
        percent_mapped=mapped,
        fidelity=fidelity,
    )
