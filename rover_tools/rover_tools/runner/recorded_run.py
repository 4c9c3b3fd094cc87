"""What a replay takes from a recording of the graph: its frames, and what was made of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions
from rover_common.ros.sync import ExactTimeSynchronizer
from rover_common.types import Command, GridMap
from rover_recorder.conversions import message_of, stamp_in
from rover_recorder.errors import RecordingError
from rover_recorder.reader import Recording
from rover_recorder.schemas import definition, same_fields

FRAME_TYPES = {
    topics.COMPRESSED_IMAGE: "sensor_msgs/msg/CompressedImage",
    topics.ODOMETRY: "nav_msgs/msg/Odometry",
    topics.STATUS: "rover_interfaces/msg/RoverStatus",
}
RESULT_TYPES = {
    topics.WORLDMAP: "nav_msgs/msg/OccupancyGrid",
    topics.COMMAND: "rover_interfaces/msg/DriveCommand",
}


@dataclass(frozen=True)
class FrameMessages:
    """One telemetry."""

    stamp: int  # [ns]
    pose: Pose
    jpeg: bytes  # the file
    odometry: bytes  # CDR
    status: bytes  # CDR


@dataclass(frozen=True)
class RecordedRun:
    """A recording that can be replayed; made by `recorded_run`."""

    recording: Recording
    namespace: str  # in which the graph was recorded, with its slashes

    @property
    def frame_count(self) -> int:
        """With those of which a message is missing, which are left out of `frames`."""
        return max(self.recording.counts[self.namespace + topic] for topic in FRAME_TYPES)

    def frames(self) -> Iterator[FrameMessages]:
        """In the order of their stamps. Raises RecordingError."""
        sync = ExactTimeSynchronizer(tuple(FRAME_TYPES))
        for record in self.recording.records([self.namespace + topic for topic in FRAME_TYPES]):
            stamp = stamp_in(record.data)
            parts = sync.add(record.topic.removeprefix(self.namespace), stamp, record.data)
            if parts is not None:
                yield _frame_of(stamp, parts)

    def commands(self) -> dict[int, Command]:
        """What was decided, by the stamp [ns] of its frame; empty where it was not recorded."""
        kind = RESULT_TYPES[topics.COMMAND]
        records = self.recording.records([self.namespace + topics.COMMAND])
        return dict(conversions.command_of(message_of(kind, record.data)) for record in records)

    def last_map(self) -> tuple[int, GridMap] | None:
        """The last world map and its stamp [ns]; None where none was recorded."""
        record = self.recording.last(self.namespace + topics.WORLDMAP)
        if record is None:
            return None
        message = message_of(RESULT_TYPES[topics.WORLDMAP], record.data)
        return conversions.stamp_of(message.header.stamp), conversions.grid_of(message)


def recorded_run(recording: Recording) -> RecordedRun:
    """Raises RecordingError where a topic is missing, or has another type than it has now."""
    found = [name for name in recording.topics if name.endswith("/" + topics.STATUS)]
    if len(found) != 1:
        raise RecordingError(f"{recording.path} holds {len(found)} topics {topics.STATUS}, not one")
    namespace = found[0].removesuffix(topics.STATUS)
    for topic, kind in (FRAME_TYPES | RESULT_TYPES).items():
        name = namespace + topic
        if topic in FRAME_TYPES and not recording.counts.get(name):
            raise RecordingError(f"{recording.path} holds no message of {name}")
        recorded = recording.topics.get(name)
        if recorded is None:
            continue
        if recorded.type != kind or not same_fields(recorded.definition, definition(kind)):
            raise RecordingError(
                f"{recording.path}: {name} is {recorded.type} of other fields than {kind} has now"
            )
    return RecordedRun(recording, namespace)


def _frame_of(stamp: int, parts: dict[str, bytes]) -> FrameMessages:
    image, odometry = (
        message_of(FRAME_TYPES[topic], parts[topic])
        for topic in (topics.COMPRESSED_IMAGE, topics.ODOMETRY)
    )
    return FrameMessages(
        stamp=stamp,
        pose=conversions.pose_of(odometry),
        jpeg=image.data.tobytes(),
        odometry=parts[topics.ODOMETRY],
        status=parts[topics.STATUS],
    )
