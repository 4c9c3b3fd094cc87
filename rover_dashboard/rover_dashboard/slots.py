"""The newest values by name: written by the ROS thread, read by the server's."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Slot:
    """One value, with what tells it from the one before."""

    version: int  # unique among all slots' values, growing
    value: Any  # None when there is nothing to show
    received: float  # [s] of the monotonic clock


class Slots:
    """A slow reader misses the values in between, and nothing queues."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._slots: dict[str, Slot] = {}
        self._version = 0
        self._lock = threading.Lock()

    def put(self, name: str, value: Any) -> None:
        """Replace the value of this name."""
        with self._lock:
            self._version += 1
            self._slots[name] = Slot(self._version, value, self._clock())

    def get(self, name: str) -> Slot | None:
        """None when nothing has come yet."""
        with self._lock:
            return self._slots.get(name)

    def empty(self, names: Iterable[str]) -> None:
        """What these hold is no longer true: a reader is told so with the value None."""
        for name in names:
            slot = self.get(name)
            if slot is not None and slot.value is not None:
                self.put(name, None)

    def age(self, slot: Slot) -> float:
        """[s] of wall time since it came."""
        return self._clock() - slot.received
