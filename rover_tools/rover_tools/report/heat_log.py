"""A heat mission over time: what its report and its video show."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from burger_simulator.truth import Launch
from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_heat.thermal.picture import Celsius, excess_of
from rover_heat.types import HeatOverlay
from rover_tools.evaluation.results import Result
from rover_tools.report.track import StateChange, TrackBuilder, csv_of, tilt_of

ORIGIN = Pose(0.0, 0.0, 0.0)
BLANK = np.full((8, 8), math.nan, np.float32)


@dataclass(frozen=True)
class HeatMoment:
    """The robot and its mission at one tick; places are in the map frame."""

    time: float  # [s] since the mission's first tick
    pose: Pose  # the estimated one, with pitch and roll as the inertial unit has them
    speed: float  # [m/s] by the wheels, forward positive
    state: str
    reason: str
    sources_known: int
    sources_delivered: int
    payloads: int  # left on board
    distance: float  # [m] driven
    explored: float  # 0..1 of the reachable faces, as the mission estimates it
    thermal: tuple[Celsius, Celsius] = (BLANK, BLANK)  # the newest frames of both sensors
    error: float | None = None  # [m] of the estimated position, where a truth is known

    @property
    def excess(self) -> NDArray[np.float64]:
        """(2, 8) [K] of each column's warmest pixel over its sensor's median; NaN for none."""
        return np.stack([excess_of(frame) for frame in self.thermal])


@dataclass(frozen=True)
class HeatTrackPoint:
    """One row of track.csv."""

    time: float  # [s] since the mission's first tick
    x: float  # [m] map frame
    y: float  # [m]
    yaw: float  # [rad]
    tilt: float  # [rad] of the body against the vertical, the largest since the row before
    speed: float  # [m/s] forward positive
    state: str
    sources_known: int
    sources_delivered: int
    payloads: int  # left on board
    distance: float  # [m] driven
    explored: float  # [%] of the reachable faces, as the mission estimates it
    excess_1: float | None  # [K] of sensor 1's warmest pixel over its median
    excess_2: float | None  # [K]
    position_error: float | None  # [m] where a truth is known


@dataclass(frozen=True)
class HeatLog:
    """All that a heat mission's report shows; places are in the map frame."""

    title: str
    track: tuple[HeatTrackPoint, ...]
    changes: tuple[StateChange, ...]
    excess: NDArray[np.float64]  # (n, 2, 8) [K] of each point, sensor and column
    grid: GridMap | None  # the last map
    overlay: HeatOverlay  # at the end
    result: Result
    maze: Maze | None = None  # where a truth is known
    map_in_world: Pose = ORIGIN
    launches: tuple[Launch, ...] = ()  # true ones, in the maze's frame


@dataclass
class HeatLogBuilder:
    """Takes every tick of a mission, keeps what its log needs."""

    _builder: TrackBuilder[tuple[HeatTrackPoint, NDArray[np.float64]]] = field(
        default_factory=TrackBuilder
    )

    def add(self, moment: HeatMoment) -> None:
        """The next tick."""
        self._builder.add(
            moment, tilt_of(moment.pose), lambda tilt: (_point_of(moment, tilt), moment.excess)
        )

    def log(
        self,
        title: str,
        grid: GridMap | None,
        overlay: HeatOverlay,
        result: Result,
        maze: Maze | None = None,
        map_in_world: Pose = ORIGIN,
        launches: tuple[Launch, ...] = (),
    ) -> HeatLog:
        """The whole log; its track ends with the last tick."""
        self._builder.end()
        track = self._builder.track
        excess = np.array([row for _, row in track]).reshape(-1, 2, 8)
        points = tuple(point for point, _ in track)
        return HeatLog(
            title, points, self._builder.changes, excess, grid, overlay, result, maze,
            map_in_world, launches,
        )  # fmt: skip


def heat_track_csv(track: Sequence[HeatTrackPoint]) -> str:
    """The content of track.csv; a value that is not known is an empty field."""
    return csv_of(HeatTrackPoint, track)


def _point_of(moment: HeatMoment, tilt: float) -> HeatTrackPoint:
    pose = moment.pose
    warmest = [None if math.isnan(peak) else round(peak, 2) for peak in moment.excess.max(axis=1)]
    return HeatTrackPoint(
        time=round(moment.time, 3),
        x=round(pose.x, 3),
        y=round(pose.y, 3),
        yaw=round(pose.yaw, 4),
        tilt=round(tilt, 4),
        speed=round(moment.speed, 3),
        state=moment.state,
        sources_known=moment.sources_known,
        sources_delivered=moment.sources_delivered,
        payloads=moment.payloads,
        distance=round(moment.distance, 2),
        explored=round(100.0 * moment.explored, 1),
        excess_1=warmest[0],
        excess_2=warmest[1],
        position_error=None if moment.error is None else round(moment.error, 4),
    )
