"""The last heat mission of a recording, over time: its log, and the snapshots of its video."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rover_common import topics
from rover_common.frames import MAP, ODOM, bare
from rover_common.geometry import Pose, angles_from_quaternion, compose
from rover_common.ros.conversions import grid_of, pose_of, stamp_of
from rover_common.ros.sensor_conversions import imu_of
from rover_common.ros.transforms import pose_of_transform
from rover_common.types import GridMap
from rover_heat.types import HeatOverlay
from rover_recorder.conversions import message_of
from rover_recorder.errors import RecordingError
from rover_recorder.reader import Record, Recording, open_recording
from rover_tools.evaluation.results import Result
from rover_tools.report.heat_log import BLANK, ORIGIN, HeatLogBuilder, HeatMoment
from rover_tools.report.heat_truth import NO_TRUTH, HeatTruth
from rover_tools.report.recorded_places import overlay_of, sources_of, thermal_of
from rover_tools.report.video.heat_scene import HeatSnapshot

TF = "/tf"
NEEDED = (topics.HEAT_STATE, topics.ODOMETRY)
THERMAL = {topics.TEMPERATURE_1: 0, topics.TEMPERATURE_2: 1}
TOPICS = (*NEEDED, *THERMAL, topics.IMU, topics.MAP, topics.HEAT_SOURCES, topics.HEAT_MARKERS)
SAME_START = 0.5  # [s] two states of one mission agree on its start
PERIOD = 0.1  # [s] between two poses that are decoded, which takes most of the time


@dataclass(frozen=True)
class RecordedHeat:
    """Made by `read_heat_mission`."""

    truth: HeatTruth
    builder: HeatLogBuilder
    snapshots: tuple[HeatSnapshot, ...]  # one a second
    grid: GridMap | None  # the last one
    overlay: HeatOverlay  # at the end
    state: Any  # the last HeatState

    def result(self) -> Result:
        """As the mission itself reports it."""
        state = self.state
        return {
            "done": state.state_name == "DONE",
            "reason": state.reason,
            "time": round(state.elapsed, 1),
            "sources_known": state.sources_known,
            "sources_delivered": state.sources_delivered,
            "payloads": state.payloads,
            "ramp_done": state.ramp_done,
            "interrupts": state.interrupts,
            "distance": round(state.distance, 1),
        }


def holds_heat_mission(recording: Recording) -> bool:
    return any(name.endswith(f"/{topics.HEAT_STATE}") for name in recording.topics)


def read_heat_mission(path: Path, truth: HeatTruth = NO_TRUTH) -> RecordedHeat:
    """Read the last heat mission of the recording that a path names.

    Raises RecordingError, also when it holds none.
    """
    return _Reader(open_recording(path), truth).read()


class _Reader:
    """Follows the recording, and begins anew with every mission."""

    def __init__(self, recording: Recording, truth: HeatTruth) -> None:
        self._recording = recording
        self._truth = truth
        self._grid: GridMap | None = None
        self._overlay = HeatOverlay()
        self._state: Any = None
        self._correction: Pose | None = None  # of odom in the map
        self._odometry: Any = None  # the newest
        self._tilt = (0.0, 0.0)  # [rad] pitch and roll
        self._thermal = [BLANK, BLANK]
        self._decoded: dict[str, float] = {}  # [s] stamps of the newest that were decoded
        self._begin(0.0)

    def read(self) -> RecordedHeat:
        # A graph in a namespace has it before each topic's name.
        names = {
            name: topic
            for name in self._recording.topics
            for topic in TOPICS
            if name.endswith(f"/{topic}")
        }
        for record in self._recording.records([*names, TF]):
            self._take(names.get(record.topic, TF), record)
        if self._state is None or self._moment is None:
            raise RecordingError(f"{self._recording.path} holds no heat mission")
        self._add_moment()  # the last pose again, with the state that was decided on it
        self._keep_snapshot()
        snapshots = tuple(self._snapshots)
        return RecordedHeat(
            self._truth, self._builder, snapshots, self._grid, self._overlay, self._state
        )

    def _begin(self, start: float) -> None:
        """start [s]: stamp of the mission's first tick."""
        self._start = start
        self._builder = HeatLogBuilder()
        self._snapshots: list[HeatSnapshot] = []
        self._moment: HeatMoment | None = None
        self._explored = 0.0

    def _take(self, topic: str, record: Record) -> None:
        stamp = record.publish_time * 1e-9
        if topic in (topics.ODOMETRY, topics.IMU):
            if stamp - self._decoded.get(topic, -math.inf) < PERIOD:
                return
            self._decoded[topic] = stamp
        message = message_of(self._recording.topics[record.topic].type, record.data)
        if topic == topics.HEAT_STATE:
            self._take_state(message)
        elif topic == topics.ODOMETRY:
            self._odometry = message
            self._add_moment()
        elif topic == TF:
            self._take_transforms(message)
        elif topic == topics.IMU:
            orientation = imu_of(message).orientation
            if orientation is not None:
                roll, pitch, _ = angles_from_quaternion(*orientation)
                self._tilt = pitch, roll
        elif topic == topics.MAP:
            self._grid = grid_of(message)
        elif topic == topics.HEAT_SOURCES:
            self._overlay = replace(self._overlay, sources=sources_of(message))
        elif topic == topics.HEAT_MARKERS:
            self._overlay = overlay_of(message, self._overlay)
        else:
            self._thermal[THERMAL[topic]] = thermal_of(message)

    def _take_state(self, state: Any) -> None:
        start = stamp_of(state.header.stamp) * 1e-9 - state.elapsed
        if self._state is None or abs(start - self._start) > SAME_START:
            self._begin(start)
        self._state = state
        self._explored = state.explored or self._explored  # none is told beside exploring

    def _take_transforms(self, message: Any) -> None:
        for each in message.transforms:
            pair = bare(each.header.frame_id), bare(each.child_frame_id)
            if pair == (MAP, ODOM):
                self._correction = pose_of_transform(each)

    def _add_moment(self) -> None:
        """At the newest odometry."""
        state, odometry = self._state, self._odometry
        if state is None or odometry is None:
            return
        stamp = stamp_of(odometry.header.stamp)
        placed = ORIGIN
        if self._correction is not None:
            placed = compose(self._correction, pose_of(odometry))
        pitch, roll = self._tilt
        self._moment = HeatMoment(
            time=stamp * 1e-9 - self._start,
            pose=replace(placed, pitch=pitch, roll=roll),
            speed=odometry.twist.twist.linear.x,
            state=state.state_name,
            reason=state.reason,
            sources_known=state.sources_known,
            sources_delivered=state.sources_delivered,
            payloads=state.payloads,
            distance=state.distance,
            explored=self._explored,
            thermal=(self._thermal[0], self._thermal[1]),
            error=None if self._correction is None else self._truth.error_of(stamp, placed),
        )
        self._builder.add(self._moment)
        if self._moment.time >= len(self._snapshots):
            self._keep_snapshot()

    def _keep_snapshot(self) -> None:
        assert self._moment is not None
        self._snapshots.append(HeatSnapshot(self._moment, self._grid, self._overlay))
