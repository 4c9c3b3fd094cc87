"""The launcher of the payloads: one sequence at a time."""

from __future__ import annotations

SECOND = 1_000_000_000  # [ns]
SEQUENCE = 10 * SECOND + SECOND // 2  # [ns] spin up, three balls with pauses, then the report


class Launcher:
    """Stamps are [ns]."""

    def __init__(self) -> None:
        self._done_at: int | None = None

    def signal(self, stamp: int) -> bool:
        """Begin a sequence; False while one is running, which goes on."""
        if self._done_at is not None:
            return False
        self._done_at = stamp + SEQUENCE
        return True

    def reports(self, stamp: int) -> int:
        """Sequences finished since the last call: 0 or 1."""
        if self._done_at is None or stamp < self._done_at:
            return 0
        self._done_at = None
        return 1
