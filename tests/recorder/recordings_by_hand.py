"""Recordings of a few messages, without a graph."""

from __future__ import annotations

from pathlib import Path

from rover_recorder import bag
from rover_recorder.types import Topic
from rover_recorder.writer import RecordingWriter

SECOND = 1_000_000_000  # [ns]
START = 1_700_000_000 * SECOND  # [ns] of log times
STRING = Topic("/text", "std_msgs/msg/String", "string data\n", (), "RIHS01_1")
NUMBER = Topic("/number", "std_msgs/msg/UInt8", "uint8 data\n", (), "RIHS01_2")


def text_bytes(text: str) -> bytes:
    """A std_msgs/String in CDR."""
    data = text.encode() + b"\0"
    return b"\0\1\0\0" + len(data).to_bytes(4, "little") + data


def write_recording(folder: Path, seconds: int = 5, flushes: bool = True) -> Path:
    """Two topics, ten messages of each a second, flushed once a second; the MCAP file."""
    with RecordingWriter(bag.file_of(folder)) as writer:
        fill(writer, seconds, flushes)
    return writer.path


def fill(writer: RecordingWriter, seconds: int, flushes: bool = True) -> None:
    writer.add_topic(STRING)
    writer.add_topic(NUMBER)
    for tick in range(10 * seconds):
        log_time = START + tick * SECOND // 10
        writer.write("/text", log_time, tick, text_bytes(f"message {tick}"))
        writer.write("/number", log_time + 1, log_time + 1, b"\0\1\0\0" + bytes([tick % 256]))
        if flushes and tick % 10 == 9:
            writer.flush()
