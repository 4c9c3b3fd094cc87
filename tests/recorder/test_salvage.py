"""A recording whose recorder was killed at any moment: what was flushed is read, by any reader."""

from __future__ import annotations

import random

import pytest
from mcap.opcode import Opcode
from mcap.reader import make_reader
from recordings_by_hand import fill, text_bytes, write_recording
from rosbags.rosbag2 import Reader

from rover_recorder import bag
from rover_recorder.errors import RecordingError
from rover_recorder.reader import open_recording
from rover_recorder.salvage import salvage
from rover_recorder.writer import RecordingWriter

SECONDS = 5
PER_SECOND = 20  # messages


def torn_at(folder, length: int, content: bytes):
    """A recording of which so many bytes were written."""
    folder.mkdir()
    file = bag.file_of(folder)
    file.write_bytes(content[:length])
    return file


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The bytes of a recording, and where each of its flushes ended."""
    folder = tmp_path_factory.mktemp("whole") / "run"
    ends = []

    class Writer(RecordingWriter):
        def flush(self) -> None:
            super().flush()
            ends.append(self.path.stat().st_size)

    with Writer(bag.file_of(folder)) as writer:
        fill(writer, SECONDS)
    return writer.path.read_bytes(), ends


def test_what_was_flushed_is_there_wherever_the_file_ends(tmp_path, written):
    content, ends = written
    assert len(ends) == SECONDS
    chosen = random.Random(0).sample(range(9, len(content)), 60)
    for index, length in enumerate(sorted({*chosen, *ends, len(content) - 1})):
        file = torn_at(tmp_path / str(index), length, content)
        flushed = sum(end <= length for end in ends) * PER_SECOND
        if not flushed and length < ends[0]:
            try:
                recording = open_recording(file)
            except RecordingError as error:
                assert "holds no message" in str(error)
                continue
        recording = open_recording(file)
        records = list(recording.records())
        assert len(records) >= flushed, length
        assert len(records) % PER_SECOND == 0  # chunks come all or not at all
        texts = [record.data for record in records if record.topic == "/text"]
        assert texts == [text_bytes(f"message {tick}") for tick in range(len(texts))]


def test_a_salvaged_recording_opens_in_every_reader_and_is_whole_from_then_on(tmp_path, written):
    content, ends = written
    file = torn_at(tmp_path / "run", ends[2] + 100, content)
    recording = open_recording(tmp_path / "run")
    assert recording.salvaged
    assert recording.counts == {"/text": 30, "/number": 30}
    with file.open("rb") as stream:
        assert len(list(make_reader(stream, validate_crcs=True).iter_messages())) == 60
    with Reader(tmp_path / "run") as reader:
        assert reader.message_count == len(list(reader.messages())) == 60
    assert sorted(path.name for path in file.parent.iterdir()) == ["metadata.yaml", "run_0.mcap"]
    assert not open_recording(tmp_path / "run").salvaged


def test_a_folder_without_metadata_gets_one(
    tmp_path,
):
    write_recording(tmp_path / "run")
    (tmp_path / "run" / "metadata.yaml").unlink()
    assert open_recording(tmp_path / "run").salvaged
    with Reader(tmp_path / "run") as reader:
        assert reader.message_count == 100


def test_a_lone_torn_file_gets_no_metadata(tmp_path, written):
    content, ends = written
    file = tmp_path / "alone.mcap"
    file.write_bytes(content[: ends[1]])
    assert salvage(file) == 40
    assert [path.name for path in tmp_path.iterdir()] == ["alone.mcap"]


def test_a_torn_file_without_a_message_is_left_as_it_is(tmp_path, written):
    content, _ = written
    file = torn_at(tmp_path / "run", 60, content)
    with pytest.raises(RecordingError, match="holds no message"):
        open_recording(file)
    assert file.read_bytes() == content[:60]
    assert [path.name for path in file.parent.iterdir()] == ["run_0.mcap"]


def test_a_recording_that_still_runs_is_not_salvaged(tmp_path):
    with RecordingWriter(bag.file_of(tmp_path / "run")) as writer:
        fill(writer, 2)
        with pytest.raises(RecordingError, match="still being recorded"):
            open_recording(tmp_path / "run")
        fill_more = text_bytes("after")
        writer.write("/text", 1, 1, fill_more)
    assert open_recording(tmp_path / "run").counts["/text"] == 21


def test_an_interrupted_salvage_is_begun_anew(tmp_path, written):
    content, ends = written
    file = torn_at(tmp_path / "run", ends[1], content)
    file.with_name(f".{file.name}.salvaged").write_bytes(b"half")
    assert salvage(file) == 40
    assert not open_recording(file).salvaged


def test_a_damaged_chunk_is_told(tmp_path):
    file = write_recording(tmp_path / "run")
    content = bytearray(file.read_bytes())
    content[200:210] = bytes(10)
    file.write_bytes(content)
    with pytest.raises(RecordingError, match="is damaged"):
        list(open_recording(file).records())


def test_a_chunk_that_says_it_is_of_impossible_size_is_damaged(tmp_path):
    file = write_recording(tmp_path / "run")
    content = bytearray(file.read_bytes())
    chunk = 8 + 9 + int.from_bytes(content[9:17], "little")  # after the magic and the header
    assert content[chunk] == Opcode.CHUNK
    size = slice(chunk + 9 + 16, chunk + 9 + 24)  # after its length, first and last time
    content[size] = (1 << 63).to_bytes(8, "little")
    file.write_bytes(content)
    with pytest.raises(RecordingError, match="is damaged"):
        list(open_recording(file).records())
