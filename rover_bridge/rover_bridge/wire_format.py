"""What a packet may look like, checked before it is parsed; and how its JSON is read."""

from __future__ import annotations

import json
import re
from typing import Any

import socketio.packet

from rover_common.errors import RoverError

MAX_MESSAGE_BYTES = 4 * 2**20  # a telemetry has about 10 kB
MAX_CONTROL_LENGTH = 256  # characters of a packet that is no Socket.IO message
MAX_VALUES = 10_000  # JSON values in one message; a telemetry has 15

# Engine.IO: 1 close, 2 ping, 3 pong, 5 upgrade, 6 noop, 4 message. Socket.IO in a message: 0
# connect, 1 disconnect, 2 event, 3 acknowledgement. Neither protocol has binary parts.
CONTROL = re.compile(r"[12356]")
MESSAGE = re.compile(r"4[0123]")


class WireError(RoverError, ValueError):
    """A packet that no client of either protocol sends."""


def check_packet(text: object) -> None:
    """Raises WireError; takes a time that hardly depends on what is in the packet."""
    if not isinstance(text, str):
        raise WireError("a binary message")
    if CONTROL.match(text):
        if len(text) > MAX_CONTROL_LENGTH:
            raise WireError(f"a control packet of {len(text)} characters")
    elif not MESSAGE.match(text):
        raise WireError(f"{text[:20]!r} is no packet")
    elif len(text) > MAX_VALUES and sum(map(text.count, ",[{")) > MAX_VALUES:
        raise WireError(f"a message of more than {MAX_VALUES} values")


def read_json(text: str) -> Any:
    """As json.loads, with integers of any length: beyond a float's range they are infinite."""
    try:
        return json.loads(text, parse_int=_integer)
    except RecursionError:
        raise WireError("a message of too many levels") from None


def _integer(digits: str) -> int | float:
    return int(digits) if len(digits) < 100 else float(digits)


class _Json:
    dumps = staticmethod(json.dumps)

    @staticmethod
    def loads(text: str) -> Any:
        return read_json(text)


class WirePacket(socketio.packet.Packet):
    """A Socket.IO packet with this JSON."""

    json = _Json
