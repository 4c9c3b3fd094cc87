"""Join the messages of one frame that arrive on several topics."""

from __future__ import annotations

from typing import Any


class ExactTimeSynchronizer:
    """Collects messages by stamp; a set is complete with one of that stamp from every source.

    Keeps at most `queue_size` incomplete sets; the oldest is dropped first, and counted in
    `dropped`.
    """

    def __init__(self, sources: tuple[str, ...], queue_size: int = 8) -> None:
        self._sources = frozenset(sources)
        self._queue_size = queue_size
        self._sets: dict[int, dict[str, Any]] = {}
        self.dropped = 0

    def add(self, source: str, stamp: int, message: Any) -> dict[str, Any] | None:
        """Store a message of this stamp [ns]; the complete set by source when it was the last one.

        Raises KeyError for a source that was not named.
        """
        if source not in self._sources:
            raise KeyError(source)
        messages = self._sets.setdefault(stamp, {})
        messages[source] = message
        if len(messages) == len(self._sources):
            return self._sets.pop(stamp)
        while len(self._sets) > self._queue_size:
            del self._sets[next(iter(self._sets))]
            self.dropped += 1
        return None

    def clear(self) -> None:
        """Forget all incomplete sets, uncounted: a new run begins."""
        self._sets.clear()
