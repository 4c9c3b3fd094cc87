"""Reads a recording: this package's own, or one that `ros2 bag record` made in MCAP."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mcap.reader import make_reader

from rover_recorder import bag
from rover_recorder.errors import RecordingError
from rover_recorder.salvage import DAMAGE, is_whole, salvage
from rover_recorder.types import Record, Topic

FOLDER = "recording"  # of a run, in its result folder


@dataclass(frozen=True)
class Recording:
    """A whole recording; made by `open_recording`."""

    path: Path  # of the MCAP file
    topics: dict[str, Topic]  # by name
    counts: dict[str, int]  # messages by topic
    start: int  # [ns] log time of the first message
    end: int  # [ns] of the last one
    salvaged: bool  # just now

    def records(
        self,
        topics: Collection[str] | None = None,
        start: int | None = None,
        end: int | None = None,
    ) -> Iterator[Record]:
        """The messages of these topics, or of all, in the order of their log times.

        start, end [ns]: log times, both included. Raises RecordingError where the file is damaged.
        """
        return self._found(topics=topics, starting_at=start, ending_at=end)

    def last(self, topic: str) -> Record | None:
        """The last message of a topic; None where there is none. Raises RecordingError."""
        return next(self._found(topics=[topic], reverse=True), None)

    def _found(self, **conditions: Any) -> Iterator[Record]:
        with self.path.open("rb") as stream:
            found = make_reader(stream, validate_crcs=True).iter_messages(**conditions)
            try:
                for _, channel, message in found:
                    yield Record(
                        channel.topic, message.log_time, message.publish_time, message.data
                    )
            except DAMAGE as error:
                raise RecordingError(f"{self.path} is damaged: {error}") from error


def find_recording(path: Path) -> Path | None:
    """The MCAP file that a path names: itself, or that of its folder, or of a run's result folder.

    None where there is none, as in the folder of another kind of run.
    """
    if path.is_file():
        return path
    for folder in (path, path / FOLDER):
        files = sorted(folder.glob("[!.]*.mcap"))
        if len(files) > 1:
            raise RecordingError(f"{folder} holds {len(files)} MCAP files; name one of them")
        if files:
            return files[0]
    return None


def open_recording(path: Path) -> Recording:
    """Open the recording that a path names, and salvage it first if its recorder was killed.

    Raises RecordingError when there is none, or it cannot be read, and OSError.
    """
    file = find_recording(path)
    if file is None:
        raise RecordingError(f"{path} holds no recording: there is no .mcap file in it")
    file = file.absolute()
    torn = not is_whole(file) or _lacks_metadata(file)
    if torn:
        salvage(file)
    return _opened(file, torn)


def _lacks_metadata(file: Path) -> bool:
    """Whether the recorder was killed just before its last step."""
    return file == bag.file_of(file.parent) and not (file.parent / bag.METADATA).exists()


def _opened(file: Path, salvaged: bool) -> Recording:
    with file.open("rb") as stream:
        try:
            reader = make_reader(stream)
            profile, summary = reader.get_header().profile, reader.get_summary()
        except DAMAGE as error:
            raise RecordingError(f"{file} is damaged: {error}") from error
    if profile != bag.PROFILE:
        raise RecordingError(f"{file} is not a recording of ROS 2")
    if summary is None or summary.statistics is None:
        raise RecordingError(f"{file} has no index")
    if not summary.statistics.message_count:
        raise RecordingError(f"{file} holds no message")
    counts = summary.statistics.channel_message_counts
    return Recording(
        path=file,
        topics={
            c.topic: bag.topic_of(c, summary.schemas[c.schema_id])
            for c in summary.channels.values()
        },
        counts={c.topic: counts.get(c.id, 0) for c in summary.channels.values()},
        start=summary.statistics.message_start_time,
        end=summary.statistics.message_end_time,
        salvaged=salvaged,
    )
