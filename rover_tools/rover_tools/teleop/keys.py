"""What the keys mean: each press changes the velocity that is asked for by one step."""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import Enum

from rover_common.sensor_types import Twist

SPEED_STEP = 0.5  # [m/s]
SPEEDS = (-1.5, 3.0)  # [m/s]
TURN_STEPS = 3  # to the tightest curve
TIGHTEST = 0.35  # [1/m] what the rover's steering gives
TURN_RATE = 0.6  # [rad/s] in place, at the last step

HELP = "w/s or up/down: speed   a/d or left/right: turn   space: brake   q: end"


class Key(Enum):
    FASTER = "faster"
    SLOWER = "slower"
    LEFT = "left"
    RIGHT = "right"
    BRAKE = "brake"
    END = "end"


# What a terminal sends; an arrow is an escape sequence, in either of its two modes.
CODES = {
    b"w": Key.FASTER, b"s": Key.SLOWER, b"a": Key.LEFT, b"d": Key.RIGHT,
    b"\x1b[A": Key.FASTER, b"\x1b[B": Key.SLOWER, b"\x1b[D": Key.LEFT, b"\x1b[C": Key.RIGHT,
    b"\x1bOA": Key.FASTER, b"\x1bOB": Key.SLOWER, b"\x1bOD": Key.LEFT, b"\x1bOC": Key.RIGHT,
    b" ": Key.BRAKE, b"q": Key.END, b"\x04": Key.END,
}  # fmt: skip
CODE = re.compile(rb"\x1b[\[O][ -?]*[@-~]|.", re.DOTALL)


def keys_of(data: bytes) -> Iterator[Key]:
    """The keys in what a terminal has sent; others are ignored, capitals count."""
    for code in CODE.findall(data):
        key = CODES.get(code) or CODES.get(code.lower())
        if key is not None:
            yield key


class KeyDriver:
    """The velocity that was asked for; it stands until a key changes it."""

    def __init__(self) -> None:
        self._speed = 0.0  # [m/s]
        self._turn = 0  # steps, left positive

    def press(self, key: Key) -> None:
        """Speed and turn change by a step; the brake takes both away."""
        least, most = SPEEDS
        if key is Key.FASTER:
            self._speed = min(most, self._speed + SPEED_STEP)
        elif key is Key.SLOWER:
            self._speed = max(least, self._speed - SPEED_STEP)
        elif key is Key.LEFT:
            self._turn = min(TURN_STEPS, self._turn + 1)
        elif key is Key.RIGHT:
            self._turn = max(-TURN_STEPS, self._turn - 1)
        else:
            self._speed, self._turn = 0.0, 0

    @property
    def velocity(self) -> Twist:
        """A curve while it drives, a turn in place while it does not; left is left of the rover."""
        share = self._turn / TURN_STEPS
        rate = TIGHTEST * abs(self._speed) if self._speed else TURN_RATE
        return Twist(self._speed, share * rate)
