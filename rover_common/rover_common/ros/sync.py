"""Join the parts of one frame that arrive on several topics."""

from __future__ import annotations

from typing import Any


class ExactTimeSynchronizer:
    """Collects parts by stamp; a set is complete when every slot has a part of that stamp.

    Keeps at most `pending` incomplete stamps; the oldest goes first, and is counted in `dropped`.
    """

    def __init__(self, slots: tuple[str, ...], pending: int = 8) -> None:
        self._slots = frozenset(slots)
        self._pending = pending
        self._parts: dict[int, dict[str, Any]] = {}
        self.dropped = 0

    def add(self, slot: str, stamp: int, part: Any) -> dict[str, Any] | None:
        """Store a part; return all parts of its stamp by slot when it was the last one."""
        if slot not in self._slots:
            raise KeyError(slot)
        parts = self._parts.setdefault(stamp, {})
        parts[slot] = part
        if len(parts) == len(self._slots):
            return self._parts.pop(stamp)
        while len(self._parts) > self._pending:
            del self._parts[next(iter(self._parts))]
            self.dropped += 1
        return None

    def clear(self) -> None:
        """Forget all incomplete sets, uncounted: a new run begins."""
        self._parts.clear()
