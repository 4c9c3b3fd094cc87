"""Waits for a condition of another process, of which no event tells."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

LOOK = 0.01  # [s] between two looks


def holds(condition: Callable[[], object], seconds: float) -> bool:
    """Whether the condition comes true in time [s]; at once when it does."""
    end, pause = time.monotonic() + seconds, threading.Event()
    while not condition():
        if time.monotonic() > end:
            return False
        pause.wait(LOOK)
    return True
