"""What a JPEG file says of itself before its picture: its kind and its size (ITU T.81, annex B)."""

from __future__ import annotations

from dataclasses import dataclass

from rover_bridge.errors import JpegError

START, END = b"\xff\xd8", b"\xff\xd9"
MAX_BYTES = 512 * 1024  # a file of the camera has 6 kB, its raw pixels 150 kB

START_OF_SCAN = 0xDA
SEQUENTIAL = (0xC0, 0xC1)  # frames with Huffman codes, each pixel coded once
# Others code the picture in many passes, by arithmetic, or without loss. The camera has none of
# them, and a file of thousands of passes takes seconds.
OTHER_FRAMES = frozenset(range(0xC2, 0xD0)) - {0xC4, 0xC8, 0xCC}  # not tables, not reserved


@dataclass(frozen=True)
class JpegHeader:
    """The frame of a sequential JPEG file."""

    width: int  # [px]
    height: int  # [px]
    components: int  # 1 grey, 3 colour


def read_header(data: bytes) -> JpegHeader:
    """Of a whole sequential file with one scan; reads the segments before it alone.

    Raises JpegError for anything else.
    """
    if not (data.startswith(START) and data.endswith(END)):
        raise JpegError("image is not a whole JPEG file")
    if len(data) > MAX_BYTES:
        raise JpegError(f"image is a file of {len(data)} bytes")
    header = None
    for marker, segment in _segments(data):
        if marker in OTHER_FRAMES or (marker in SEQUENTIAL and header is not None):
            raise JpegError("image is not one picture of sequential JPEG")
        if marker in SEQUENTIAL:
            header = _frame(segment)
        elif marker == START_OF_SCAN:
            if header is None or segment[:1] != bytes([header.components]):
                raise JpegError("image has no scan of all its components")
            return header
    raise JpegError("image has no scan")


def _frame(segment: bytes) -> JpegHeader:
    if len(segment) < 6 or segment[0] != 8 or segment[5] not in (1, 3):
        raise JpegError("image is not of 8 bits in one or three components")
    height, width = int.from_bytes(segment[1:3], "big"), int.from_bytes(segment[3:5], "big")
    return JpegHeader(width, height, segment[5])


def _segments(data: bytes) -> list[tuple[int, bytes]]:
    """Marker and contents of the segments up to the first scan."""
    segments: list[tuple[int, bytes]] = []
    position = len(START)
    while position + 4 <= len(data):
        if data[position] != 0xFF:
            raise JpegError("image has bytes between its segments")
        marker = data[position + 1]
        if marker == 0xFF:  # a fill byte
            position += 1
            continue
        length = int.from_bytes(data[position + 2 : position + 4], "big")
        if marker == 0 or 0xD0 <= marker <= 0xD9 or length < 2:
            raise JpegError("image has a broken segment")
        segments.append((marker, data[position + 4 : position + 2 + length]))
        if marker == START_OF_SCAN:
            break
        position += 2 + length
    return segments
