"""Values of a command, parsed as the Unity simulator does: strings only, or an exception."""

from __future__ import annotations

import base64
import re
from typing import Any

# Its numbers are 32 bits wide; larger ones overflow.
LARGEST = 3.4028235e38
# Narrower than Python's: no underscores, no digits of other scripts, no names for infinity.
NUMBER = re.compile(r"\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*")


def parse_number(text: Any) -> float:
    """A finite number from a string, with a decimal point.

    Raises TypeError for what is no string, ValueError for what is no such number.
    """
    if not isinstance(text, str):
        raise TypeError(f"{text!r:.40} is not a string")
    if NUMBER.fullmatch(text) is None:
        raise ValueError(f"{text!r:.40} is not a number")
    value = float(text)
    if abs(value) > LARGEST:
        raise ValueError(f"{text!r:.40} is too large")
    return value


def parse_base64(text: Any) -> bytes:
    """What a string encodes.

    Raises TypeError for what is no string, ValueError for what is no base64.
    """
    if not isinstance(text, str):
        raise TypeError(f"{text!r:.40} is not a string")
    return base64.b64decode("".join(text.split()), validate=True)
