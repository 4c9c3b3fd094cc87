"""What a client that is broken or hostile sends to the bridge: bytes, by the shape's name.

A client that is not the active one is answered with the brake before its telemetry is decoded, so
nothing here can take the rover over. What is sent is small in number; the bridge has the limits.
"""

from __future__ import annotations

import base64
import json
import random
import struct
import zlib
from collections.abc import Callable, Mapping
from typing import Any

HANDSHAKE = (
    b"GET /socket.io/?EIO=4&transport=websocket HTTP/1.1\r\nHost: 127.0.0.1\r\n"
    b"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)
TEXT, BINARY = 1, 2  # opcodes of WebSocket frames
HUGE = 65_500  # pixels of a picture's side
DEPTH = 4_000  # of nested lists

# What each value of a telemetry may be instead of a number.
WRONG: tuple[Any, ...] = (
    "", "NaN", "-Infinity", "1e999", "9" * 400, "0x10", "1;2;3", "\u0661", None, True, [], {},
    [[1]], 10**40, "1,2,3,4", ";" * 50,
)  # fmt: skip
KEYS = (
    "steering_angle", "throttle", "brake", "speed", "position", "pitch", "yaw", "roll",
    "near_sample", "picking_up", "sample_count", "samples_x", "samples_y", "image", "sim_time",
)  # fmt: skip
GOOD = dict.fromkeys(KEYS, "0.0000") | {"position": "100.0000;85.0000", "sample_count": "0"}
GOOD |= {"near_sample": "0", "picking_up": "0", "samples_x": "", "samples_y": "", "image": ""}


def frame(payload: bytes, opcode: int = TEXT, final: bool = True) -> bytes:
    """A WebSocket frame of a client; its mask is zero, so that it costs nothing here."""
    first, length = (0x80 if final else 0) | opcode, len(payload)
    if length < 126:
        head = struct.pack("!BB", first, 0x80 | length)
    elif length < 65536:
        head = struct.pack("!BBH", first, 0x80 | 126, length)
    else:
        head = struct.pack("!BBQ", first, 0x80 | 127, length)
    return head + bytes(4) + payload


def event(*members: Any) -> bytes:
    """A frame with a Socket.IO event."""
    return frame(b"42" + json.dumps(members).encode())


def telemetry(**changes: Any) -> bytes:
    """A telemetry that lacks its picture, with these values changed."""
    return event("telemetry", GOOD | changes)


def malformed_telemetry(chance: random.Random) -> bytes:
    """Wrong values, keys that are missing, and arguments that are no object."""
    wrong = {key: chance.choice(WRONG) for key in chance.sample(KEYS, 5)}
    fewer = {key: GOOD[key] for key in chance.sample(KEYS, 7)}
    odd = chance.choice(([], "text", 7, None, [GOOD] * 3))
    return telemetry(**wrong) + event("telemetry", fewer) + event("telemetry", odd)


def half_frames(chance: random.Random) -> bytes:
    """A good telemetry that is cut anywhere; whoever sends it leaves then."""
    whole = frame(b"42" + json.dumps(["telemetry", GOOD]).encode(), final=chance.random() < 0.5)
    return whole[: chance.randrange(1, len(whole))]


def picture_bombs(chance: random.Random) -> bytes:
    """Files of a few bytes that claim pictures of gigabytes, and long ones that are none."""
    header = struct.pack("!IIBBBBB", HUGE, HUGE, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(bytes(100_000))), (b"IEND", b""))
    png = b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack("!I", len(data)) + name + data + struct.pack("!I", zlib.crc32(name + data))
        for name, data in chunks
    )
    scan = struct.pack("!HBHHB", 17, 8, HUGE, HUGE, 3) + bytes([1, 34, 0, 2, 17, 1, 3, 17, 1])
    jpeg = b"\xff\xd8\xff\xc0" + scan + b"\xff\xd9"
    pictures = (png, jpeg, bytes(300_000), chance.randbytes(20_000))
    return b"".join(telemetry(image=base64.b64encode(p).decode()) for p in pictures)


def bad_clocks(chance: random.Random) -> bytes:
    """Telemetries whose clock stands, falls back, leaps or is none."""
    times = (0.0, -5.0, 1e12, chance.uniform(0.0, 1e6), "noon", "NaN")
    return b"".join(telemetry(sim_time=f"{t:.4f}" if isinstance(t, float) else t) for t in times)


def nested_packets(chance: random.Random) -> bytes:
    """JSON that is deep or long, and packets that are none."""
    deep = b"42" + b"[" * chance.randrange(100, DEPTH)
    packets = (deep, b"42" + b'["telemetry",' * 50, b"451-[]", b"4" + b"2" * 100_000, b"hello")
    return frame(chance.choice(packets))


def garbage(chance: random.Random) -> bytes:
    """Frames of no kind, without a mask, of no text."""
    noise = chance.randbytes(2_000)
    return chance.choice(
        (noise, frame(noise, BINARY), frame(noise), frame(b"x", opcode=3), b"\x81\x10" + noise)
    )


WIRE_SHAPES: Mapping[str, Callable[[random.Random], bytes]] = {
    "malformed telemetry": malformed_telemetry,
    "half frames": half_frames,
    "picture bombs": picture_bombs,
    "bad clocks": bad_clocks,
    "nested packets": nested_packets,
    "garbage": garbage,
}
