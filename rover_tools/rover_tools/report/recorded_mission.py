"""The last mission of a recording, over time: its log, and the snapshots of its video."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common import topics
from rover_common.map_encoding import navigable_cells
from rover_common.ros.conversions import grid_of, pose_of, rocks_of, stamp_of
from rover_common.types import GridMap, RockTrack
from rover_decision.missions.sample_return.chart import State
from rover_recorder.conversions import message_of
from rover_recorder.errors import RecordingError
from rover_recorder.reader import Recording, open_recording
from rover_tools.evaluation.results import Result, Truth, score
from rover_tools.evaluation.scoring import score_map
from rover_tools.report.mission_log import LogBuilder, MissionLog, Moment
from rover_tools.report.video.mission_video import evenly
from rover_tools.report.video.snapshot import Image, Snapshot

VISION = f"{topics.VISION_IMAGE}/compressed"
TOPICS = (
    topics.COMPRESSED_IMAGE, VISION, topics.WORLDMAP, topics.ROCKS, topics.PLAN, topics.ODOMETRY,
    topics.MISSION_STATE,
)  # fmt: skip
SAME_START = 0.5  # [s] two states of one mission agree on its start
POSE_PERIOD = 0.1  # [s] between two poses that are decoded, which takes most of the time


@dataclass(frozen=True)
class Serialized:
    """A message that is decoded where it is needed."""

    type: str
    data: bytes

    def message(self) -> Any:
        return message_of(self.type, self.data)


@dataclass(frozen=True)
class RecordedMoment:
    """What was newest at one second of the mission."""

    moment: Moment
    samples_total: int
    newest: dict[str, Serialized]  # by topic

    def snapshot(self, truth: Truth) -> Snapshot:
        """For the video."""
        grid = _grid_in(self.newest)
        rocks = [(rock.x, rock.y) for rock in _rocks_in(self.newest)]
        return Snapshot(
            self.moment,
            self.samples_total,
            _image_in(self.newest, topics.COMPRESSED_IMAGE),
            _image_in(self.newest, VISION),
            grid,
            np.array(rocks, float).reshape(-1, 2),
            _path_in(self.newest),
            _score(grid, truth),
        )


@dataclass(frozen=True)
class RecordedMission:
    """Made by `read_mission`."""

    truth: Truth
    moments: tuple[RecordedMoment, ...]  # one a second
    grid: GridMap | None  # the last one
    rocks: tuple[RockTrack, ...]  # at the end
    state: Any  # the last MissionState
    _builder: LogBuilder

    def result(self) -> Result:
        """As the rover itself reports it, with the scores where there is a truth."""
        state = self.state
        return {
            "done": state.state_name == State.DONE.name,
            "reason": state.reason,
            "time": round(state.elapsed, 1),
            **score(self.grid, self.rocks, self.truth),
            "samples_collected": state.samples_collected,
            "samples_total": state.samples_total,
            "home_distance": round(state.home_distance, 2),
            "distance": round(state.distance, 1),
            "recoveries": state.recoveries,
        }

    def log(self, title: str, result: Result) -> MissionLog:
        return self._builder.log(title, self.grid, self.rocks, result)

    def snapshots(self, most: int) -> Iterator[Snapshot]:
        """At most so many, evenly over the mission, and the last moment."""
        chosen = evenly(most, len(self.moments))
        return (self.moments[number].snapshot(self.truth) for number in chosen)


def read_mission(path: Path, truth: Truth) -> RecordedMission:
    """Read the last mission of the recording that a path names.

    Raises RecordingError, also when it holds no mission.
    """
    return _Reader(open_recording(path), truth).read()


class _Reader:
    """Follows the recording, and begins anew with every mission."""

    def __init__(self, recording: Recording, truth: Truth) -> None:
        self._recording = recording
        self._truth = truth
        self._newest: dict[str, Serialized] = {}
        self._state: Any = None
        self._begin(0.0)

    def read(self) -> RecordedMission:
        # A graph in a namespace has it before each topic's name.
        names = {
            name: topic
            for name in self._recording.topics
            for topic in TOPICS
            if name.endswith(f"/{topic}")
        }
        for record in self._recording.records(names):
            kind = self._recording.topics[record.topic].type
            stamp = record.publish_time * 1e-9
            self._take(names[record.topic], stamp, Serialized(kind, record.data))
        self._finish()
        if not self._moments:
            raise RecordingError(f"{self._recording.path} holds no mission")
        grid, rocks = _grid_in(self._newest), _rocks_in(self._newest)
        moments = tuple(self._moments)
        return RecordedMission(self._truth, moments, grid, rocks, self._state, self._builder)

    def _begin(self, start: float) -> None:
        """start [s]: stamp of the mission's first frame."""
        self._start = start
        self._builder = LogBuilder(self._truth)
        self._moments: list[RecordedMoment] = []
        self._decoded = -math.inf  # [s] stamp of the newest pose that was decoded
        self._pose: tuple[float, Serialized] | None = None  # the newest of this mission

    def _take(self, topic: str, stamp: float, serialized: Serialized) -> None:
        """stamp [s]: the message's own."""
        if topic == topics.MISSION_STATE:
            state = serialized.message()
            start = stamp_of(state.header.stamp) * 1e-9 - state.elapsed
            if self._state is None or abs(start - self._start) > SAME_START:
                self._begin(start)
            self._state = state
        elif topic == topics.ODOMETRY:
            self._pose = stamp, serialized
            if self._state is not None and stamp - self._decoded >= POSE_PERIOD:
                self._decoded = stamp
                self._add_moment(stamp, serialized.message())
        else:
            self._newest[topic] = serialized

    def _finish(self) -> None:
        """The last pose again, with the state that was decided on it."""
        if self._state is not None and self._pose is not None:
            stamp, pose = self._pose
            self._add_moment(stamp, pose.message())
            self._keep_moment()

    def _add_moment(self, stamp: float, odometry: Any) -> None:
        """stamp [s]: of the odometry."""
        state, time = self._state, stamp - self._start
        moment = Moment(
            time,
            pose_of(odometry),
            odometry.twist.twist.linear.x,
            state.state_name,
            state.reason,
            state.samples_collected,
            state.home_distance,
            state.distance,
            state.explored,
        )
        self._builder.add(moment, lambda: _grid_in(self._newest))
        self._moment = moment
        if time >= len(self._moments):
            self._keep_moment()

    def _keep_moment(self) -> None:
        total = self._state.samples_total
        self._moments.append(RecordedMoment(self._moment, total, dict(self._newest)))


def _grid_in(newest: dict[str, Serialized]) -> GridMap | None:
    grid = newest.get(topics.WORLDMAP)
    return None if grid is None else grid_of(grid.message())


def _rocks_in(newest: dict[str, Serialized]) -> tuple[RockTrack, ...]:
    rocks = newest.get(topics.ROCKS)
    return () if rocks is None else rocks_of(rocks.message())


def _image_in(newest: dict[str, Serialized], topic: str) -> Image | None:
    """(height, width, 3) RGB; None for none, and for one that cannot be decoded."""
    found = newest.get(topic)
    if found is None:
        return None
    data = np.frombuffer(found.message().data, np.uint8)
    image = cv2.imdecode(data, cv2.IMREAD_COLOR)
    return None if image is None else np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2RGB), np.uint8)


def _path_in(newest: dict[str, Serialized]) -> NDArray[np.float64]:
    """(n, 2) [m]"""
    plan = newest.get(topics.PLAN)
    places = [] if plan is None else [pose.pose.position for pose in plan.message().poses]
    return np.array([(place.x, place.y) for place in places], float).reshape(-1, 2)


def _score(grid: GridMap | None, truth: Truth) -> tuple[float, float] | None:
    """Mapped and fidelity [%]."""
    if grid is None or truth.navigable is None:
        return None
    scores = score_map(navigable_cells(grid.cells), truth.navigable)
    return scores.percent_mapped, scores.fidelity
