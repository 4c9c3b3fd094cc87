"""Writes a recording: messages into an MCAP file, and metadata.yaml at its end."""

from __future__ import annotations

import fcntl
from collections import Counter
from contextlib import suppress
from pathlib import Path
from types import TracebackType

from mcap.writer import Writer

from rover_recorder import bag
from rover_recorder.errors import RecordingError
from rover_recorder.types import Topic

CHUNK_SIZE = 4 * 1024 * 1024  # [bytes] as rosbag2 has it


class _ChunkWriter(Writer):
    """The library ends a chunk by its size alone."""

    def end_chunk(self) -> None:
        self._Writer__finalize_chunk()  # type: ignore[attr-defined]


class RecordingWriter:
    """One open recording.

    Messages are kept in memory until a chunk of them is written, by its size or by `flush`. After a
    kill everything up to the last chunk is in the file, and `salvage` makes a whole one of it. The
    file is locked while it is written, so that nobody salvages it meanwhile.
    """

    def __init__(self, path: Path) -> None:
        """Begin a file that does not exist; raises RecordingError, or OSError."""
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            self._stream = path.open("xb")
        except FileExistsError:
            raise RecordingError(f"{path} exists already") from None
        fcntl.flock(self._stream, fcntl.LOCK_EX)
        self.path = path
        self._writer = _ChunkWriter(self._stream, chunk_size=CHUNK_SIZE)
        self._writer.start(bag.PROFILE)
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._topics: dict[str, Topic] = {}
        self._counts: Counter[str] = Counter()
        self._times: tuple[int, int] | None = None

    @property
    def counts(self) -> dict[str, int]:
        """Messages by topic, of those that have one."""
        return dict(self._counts)

    def add_topic(self, topic: Topic) -> None:
        """To be called once per topic, before its first message."""
        if topic.type not in self._schemas:
            self._schemas[topic.type] = self._writer.register_schema(
                topic.type, bag.SCHEMA_ENCODING, topic.definition.encode()
            )
        self._topics[topic.name] = topic
        self._channels[topic.name] = self._writer.register_channel(
            topic.name, bag.ENCODING, self._schemas[topic.type], bag.channel_metadata(topic)
        )

    def write(self, topic: str, log_time: int, publish_time: int, data: bytes) -> None:
        """Add a message, serialized as CDR; times are [ns]. Raises OSError."""
        self._writer.add_message(self._channels[topic], log_time, data, publish_time)
        self._counts[topic] += 1
        first, last = self._times or (log_time, log_time)
        self._times = min(first, log_time), max(last, log_time)

    def flush(self) -> None:
        """Give all messages to the operating system: they outlive this process. Raises OSError."""
        self._writer.end_chunk()
        self._stream.flush()

    def close(self) -> None:
        """Write the index and metadata.yaml. Raises OSError; the file is closed in any case."""
        try:
            self._writer.finish()
            self._stream.flush()
        finally:
            self._stream.close()
        if self.path == bag.file_of(self.path.parent):
            self.write_metadata(self.path)

    def write_metadata(self, path: Path) -> None:
        """Write metadata.yaml for the file at this path."""
        start, end = self._times or (0, 0)
        bag.write_metadata(path, self._topics, self._counts, start, end)

    def abandon(self) -> None:
        """Close the file as it is; what a full disk did not take is lost."""
        with suppress(OSError):  # it is closed nevertheless
            self._stream.close()

    def __enter__(self) -> RecordingWriter:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
