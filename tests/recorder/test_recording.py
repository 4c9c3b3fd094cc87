"""Written and read again: by this package, by mcap's reader, and by rosbags'."""

from __future__ import annotations

import pytest
import yaml
from mcap.reader import make_reader
from recordings_by_hand import NUMBER, SECOND, START, STRING, text_bytes, write_recording
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from rover_common.errors import RoverError
from rover_recorder import bag
from rover_recorder.errors import RecordingError
from rover_recorder.reader import find_recording, open_recording
from rover_recorder.types import Record, Topic
from rover_recorder.writer import RecordingWriter

LATCHED = {
    "history": "keep_last", "depth": 1, "reliability": "reliable",
    "durability": "transient_local", "deadline": {"sec": 0, "nsec": 0},
    "lifespan": {"sec": 0, "nsec": 0}, "liveliness": "automatic",
    "liveliness_lease_duration": {"sec": 0, "nsec": 0}, "avoid_ros_namespace_conventions": False,
}  # fmt: skip


def test_a_recording_is_read_as_it_was_written(tmp_path):
    recording = open_recording(write_recording(tmp_path / "run"))
    assert not recording.salvaged
    assert recording.topics == {"/text": STRING, "/number": NUMBER}
    assert recording.counts == {"/text": 50, "/number": 50}
    assert (recording.start, recording.end) == (START, START + 49 * SECOND // 10 + 1)
    records = list(recording.records())
    assert len(records) == 100
    assert records[0] == Record("/text", START, 0, text_bytes("message 0"))
    assert [r.log_time for r in records] == sorted(r.log_time for r in records)


def test_topics_and_times_are_chosen(tmp_path):
    recording = open_recording(write_recording(tmp_path / "run"))
    texts = [r.publish_time for r in recording.records(["/text"], start=START + SECOND)]
    assert texts == list(range(10, 50))
    until = START + 2 * SECOND
    texts = [r.publish_time for r in recording.records(["/text"], START + SECOND, until)]
    assert texts == list(range(10, 21))
    assert recording.last("/text").publish_time == 49
    assert recording.last("/absent") is None


def test_mcaps_own_reader_opens_it(tmp_path):
    with write_recording(tmp_path / "run").open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        assert reader.get_header().profile == "ros2"
        found = [message.data for _, channel, message in reader.iter_messages("/text")]
    assert found == [text_bytes(f"message {tick}") for tick in range(50)]


def test_rosbags_opens_the_folder(tmp_path):
    write_recording(tmp_path / "run")
    types = get_typestore(Stores.ROS2_JAZZY)
    with Reader(tmp_path / "run") as reader:
        assert reader.message_count == 100
        assert reader.duration == 49 * SECOND // 10 + 1 + 1
        connections = [c for c in reader.connections if c.topic == "/text"]
        texts = [
            types.deserialize_cdr(data, connection.msgtype).data
            for connection, _, data in reader.messages(connections)
        ]
    assert texts == [f"message {tick}" for tick in range(50)]


def test_the_metadata_is_that_of_rosbag2(tmp_path):
    latched = Topic("/state", "std_msgs/msg/String", "string data\n", (LATCHED,), "RIHS01_1")
    with RecordingWriter(bag.file_of(tmp_path / "run")) as writer:
        writer.add_topic(latched)
        writer.write("/state", 5, 5, text_bytes("on"))
        writer.write("/state", 9, 9, text_bytes("off"))
    text = (tmp_path / "run" / "metadata.yaml").read_text()
    assert "&id" not in text  # no aliases
    span = {
        "duration": {"nanoseconds": 4}, "message_count": 2,
        "starting_time": {"nanoseconds_since_epoch": 5},
    }  # fmt: skip
    assert yaml.safe_load(text)["rosbag2_bagfile_information"] == {
        "version": 9, "storage_identifier": "mcap", **span,
        "topics_with_message_count": [
            {"message_count": 2, "topic_metadata": {
                "name": "/state", "type": "std_msgs/msg/String", "serialization_format": "cdr",
                "offered_qos_profiles": [LATCHED], "type_description_hash": "RIHS01_1"}},
        ],
        "compression_format": "", "compression_mode": "", "relative_file_paths": ["run_0.mcap"],
        "files": [{"path": "run_0.mcap", **span}], "custom_data": {}, "ros_distro": "jazzy",
    }  # fmt: skip
    with Reader(tmp_path / "run") as reader:
        (connection,) = reader.connections
        assert [qos.durability.name for qos in connection.ext.offered_qos_profiles] == [
            "TRANSIENT_LOCAL"
        ]
    assert open_recording(tmp_path / "run").topics == {"/state": latched}


def test_a_recording_is_found_by_its_file_its_folder_and_its_run(tmp_path):
    file = write_recording(tmp_path / "result" / "recording")
    for path in (file, file.parent, tmp_path / "result"):
        assert find_recording(path) == file
        assert open_recording(path).path == file
    assert find_recording(tmp_path) is None


def test_a_file_alone_is_enough(tmp_path):
    file = write_recording(tmp_path / "run").rename(tmp_path / "alone.mcap")
    assert not open_recording(file).salvaged
    assert len(list(open_recording(file).records())) == 100
    assert not (tmp_path / "metadata.yaml").exists()


def test_a_recording_is_not_written_over(tmp_path):
    write_recording(tmp_path / "run")
    with pytest.raises(RecordingError, match="exists already"):
        write_recording(tmp_path / "run")


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (b"", "is empty"),
        (b"no recording at all", "is not an MCAP file"),
        (b"\x89MCAP0\r\n", "holds no message"),
        (b"\x89MCAP0\r\n\x89MCAP0\r\n", "is damaged"),
    ],
)
def test_what_is_no_recording_is_one_line(tmp_path, content, problem):
    file = tmp_path / "run.mcap"
    file.write_bytes(content)
    with pytest.raises(RecordingError, match=f"run.mcap {problem}") as error:
        open_recording(file)
    assert "\n" not in str(error.value)
    assert file.read_bytes() == content


def test_a_recording_without_a_message_is_one_line(tmp_path):
    RecordingWriter(bag.file_of(tmp_path / "run")).close()
    with pytest.raises(RecordingError, match="holds no message"):
        open_recording(tmp_path / "run")


def test_a_recording_of_another_kind_is_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(bag, "PROFILE", "x-other")
    file = write_recording(tmp_path / "run")
    monkeypatch.undo()
    with pytest.raises(RecordingError, match="not a recording of ROS 2"):
        open_recording(file)


def test_a_folder_without_a_recording_or_with_two_is_one_line(tmp_path):
    with pytest.raises(RoverError, match="holds no recording"):
        open_recording(tmp_path)
    (tmp_path / "a.mcap").touch()
    (tmp_path / "b.mcap").touch()
    with pytest.raises(RoverError, match="2 MCAP files; name one"):
        open_recording(tmp_path)
