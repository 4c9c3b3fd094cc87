"""Makes a whole recording of one whose recorder was killed.

Such a file lacks its index, and its last chunk may be torn, so that no seeking reader opens it. All
chunks before are read one after another into a new file, which then takes the place of the old one.
"""

from __future__ import annotations

import fcntl
import os
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import zstandard
from mcap.exceptions import McapError
from mcap.records import Channel, Header, McapRecord, Message, Schema
from mcap.stream_reader import StreamReader

from rover_recorder import bag
from rover_recorder.errors import RecordingError
from rover_recorder.writer import RecordingWriter

MAGIC = b"\x89MCAP0\r\n"  # at the start, and at the end of a whole file
# What the library raises where a record is torn, or holds what nobody wrote.
DAMAGE = (
    McapError, zstandard.ZstdError, struct.error, ValueError, LookupError, MemoryError,
    OverflowError,
)  # fmt: skip


def is_whole(path: Path) -> bool:
    """Whether the file has its end; raises RecordingError for another kind of file, or OSError."""
    with path.open("rb") as stream:
        start = stream.read(len(MAGIC))
        if not start:
            raise RecordingError(f"{path} is empty")
        if start != MAGIC:
            raise RecordingError(f"{path} is not an MCAP file")
        stream.seek(0, os.SEEK_END)
        if stream.tell() < 2 * len(MAGIC):
            return False
        stream.seek(-len(MAGIC), os.SEEK_END)
        return stream.read() == MAGIC


def salvage(path: Path) -> int:
    """Make the file whole, in its place; the number of messages in it.

    Raises RecordingError when it is being written, or holds no message, and OSError.
    """
    new = path.with_name(f".{path.name}.salvaged")
    with path.open("rb") as stream, _unlocked(stream, path):
        new.unlink(missing_ok=True)  # of a salvage that was interrupted
        try:
            with RecordingWriter(new) as writer:
                _copy(stream, writer)
            count = sum(writer.counts.values())
            if not count:
                raise RecordingError(f"{path} holds no message")
            new.replace(path)
        finally:
            new.unlink(missing_ok=True)
    if path == bag.file_of(path.parent):
        writer.write_metadata(path)
    return count


@contextmanager
def _unlocked(stream: IO[bytes], path: Path) -> Iterator[None]:
    """A recorder that lives holds the lock of its file."""
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise RecordingError(f"{path} is still being recorded") from None
    yield


def _copy(stream: IO[bytes], writer: RecordingWriter) -> None:
    schemas: dict[int, Schema] = {}
    topics: dict[int, str] = {}
    for record in _records(stream):
        if isinstance(record, Schema):
            schemas[record.id] = record
        elif isinstance(record, Channel) and record.id not in topics:
            topics[record.id] = record.topic
            writer.add_topic(bag.topic_of(record, schemas[record.schema_id]))
        elif isinstance(record, Message):
            topic = topics[record.channel_id]
            writer.write(topic, record.log_time, record.publish_time, record.data)


def _records(stream: IO[bytes]) -> Iterator[McapRecord]:
    """Up to the first one that is torn; a chunk's records come all or not at all."""
    try:
        for record in StreamReader(stream, validate_crcs=True).records:
            if isinstance(record, Header) and record.profile != bag.PROFILE:
                return
            yield record
    except DAMAGE:
        return
