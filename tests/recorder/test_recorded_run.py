"""What a replay takes from a recording, and what it refuses."""

from __future__ import annotations

from array import array

import numpy as np
import pytest
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.serialization import deserialize_message, serialize_message
from rover_interfaces.msg import RoverStatus

from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions
from rover_common.types import Command, GridMap, Run
from rover_recorder import bag
from rover_recorder.conversions import stamp_in
from rover_recorder.errors import RecordingError
from rover_recorder.reader import open_recording
from rover_recorder.schemas import definition
from rover_recorder.types import Topic
from rover_recorder.writer import RecordingWriter
from rover_tools.runner.recorded_run import FRAME_TYPES, RESULT_TYPES, recorded_run
from rover_tools.runner.replay_recording import different_cells, different_commands

POSE = Pose(90.0, 100.0, 0.5)
TYPES = FRAME_TYPES | RESULT_TYPES


def messages_of(stamp: int) -> dict[str, bytes]:
    header = conversions.header_of(stamp, "map")
    command = conversions.command_message_of(stamp, stamp, Run(1, 0), Command(throttle=stamp / 10))
    grid = OccupancyGrid(header=header, data=array("b", [stamp] * 4))
    grid.info.width = grid.info.height = 2
    grid.info.resolution, grid.info.origin.orientation.w = 0.5, 1.0
    return {
        topic: serialize_message(message)
        for topic, message in {
            topics.ODOMETRY: conversions.odometry_of(stamp, POSE, 1.0),
            topics.COMPRESSED_IMAGE: conversions.jpeg_message_of(header, b"file %d" % stamp),
            topics.STATUS: RoverStatus(header=header, run=1),
            topics.WORLDMAP: grid,
            topics.COMMAND: command,
        }.items()
    }


def write(folder, namespace="/", absent=(), incomplete=(), changed=None):
    """Three frames, of stamps 1 to 3; without some topics, or some messages of stamp 2."""
    with RecordingWriter(bag.file_of(folder)) as writer:
        kinds = {topic: kind for topic, kind in TYPES.items() if topic not in absent}
        for topic, kind in kinds.items():
            text = definition(kind)
            text = text.replace(*changed) if changed else text
            writer.add_topic(Topic(namespace + topic, kind, text))
        for stamp in (1, 2, 3):
            for topic, data in messages_of(stamp).items():
                if topic in kinds and not (stamp == 2 and topic in incomplete):
                    writer.write(namespace + topic, 1000 + stamp, 77, data)
    return open_recording(folder)


@pytest.mark.parametrize("namespace", ["/", "/robots/one/"])
def test_frames_commands_and_the_last_map_are_found(tmp_path, namespace):
    run = recorded_run(write(tmp_path / "run", namespace))
    frames = list(run.frames())
    assert run.frame_count == 3
    assert [frame.stamp for frame in frames] == [1, 2, 3]
    assert [frame.jpeg for frame in frames] == [b"file 1", b"file 2", b"file 3"]
    odometry = deserialize_message(frames[0].odometry, Odometry)  # its bytes have undefined padding
    assert odometry == conversions.odometry_of(1, POSE, 1.0)
    assert (frames[0].pose.x, frames[0].pose.yaw) == (90.0, pytest.approx(0.5))
    assert run.commands() == {stamp: Command(throttle=stamp / 10) for stamp in (1, 2, 3)}
    stamp, grid = run.last_map()
    assert stamp == 3
    assert grid.cells.tolist() == [[3, 3], [3, 3]]


def test_a_frame_that_lacks_a_message_is_left_out(tmp_path):
    run = recorded_run(write(tmp_path / "run", incomplete=(topics.STATUS,)))
    assert [frame.stamp for frame in run.frames()] == [1, 3]
    assert run.frame_count == 3


def test_a_recording_without_maps_and_commands_can_be_replayed(tmp_path):
    run = recorded_run(write(tmp_path / "run", absent=(topics.WORLDMAP, topics.COMMAND)))
    assert len(list(run.frames())) == 3
    assert run.last_map() is None
    assert run.commands() == {}


@pytest.mark.parametrize("topic", FRAME_TYPES)
def test_a_topic_that_is_missing_is_named(tmp_path, topic):
    recording = write(tmp_path / "run", absent=(topic,))
    with pytest.raises(RecordingError, match=rf"holds (no message of /|0 topics ){topic}"):
        recorded_run(recording)


def test_another_definition_is_refused_but_not_another_comment(tmp_path):
    recorded_run(write(tmp_path / "same", changed=("# counts the runs from 1", "# other words")))
    other = write(tmp_path / "other", changed=("bool near_sample", "uint8 near_sample"))
    with pytest.raises(RecordingError, match=r"/rover_status is .* of other fields than"):
        recorded_run(other)


def test_stamps_are_read_from_the_bytes():
    stamp = 1_700_000_000_123_456_789
    assert stamp_in(messages_of(1)[topics.STATUS]) == 1
    assert (
        stamp_in(serialize_message(RoverStatus(header=conversions.header_of(stamp, "")))) == stamp
    )
    assert stamp_in(b"\0\0\0\0" + (7).to_bytes(4, "big") + (5).to_bytes(4, "big")) == 7_000_000_005


def test_differences_are_counted():
    one, other = Command(throttle=1.0), Command(brake=1.0)
    assert different_commands({1: one, 2: one, 3: one}, {2: one, 3: other, 4: one}) == 1
    cells = np.zeros((2, 3), np.int8)
    changed = cells.copy()
    changed[1, 2] = -1
    maps = [GridMap(1.0, 0.0, 0.0, c) for c in (cells, changed)]
    assert different_cells(maps[0], maps[1]) == 1
    assert different_cells(maps[0], maps[0]) == 0
    assert different_cells(maps[0], None) is None
