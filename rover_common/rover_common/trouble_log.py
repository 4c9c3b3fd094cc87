"""When a trouble is worth a line in the log: as it begins, and never while it lasts."""

from __future__ import annotations

PEACE = 5.0  # [s] without a trouble, after which it has ended


class TroubleLog:
    """Troubles by name; `now` is [s] of any clock that does not fall back."""

    def __init__(self) -> None:
        self._began: dict[str, float] = {}
        self._last: dict[str, float] = {}

    def begins(self, name: str, now: float) -> bool:
        """It happens now; whether it did not for a while before."""
        begins = now - self._last.get(name, -PEACE) >= PEACE
        if begins:
            self._began[name] = now
        self._last[name] = now
        return begins

    def ends(self, name: str, now: float) -> float | None:
        """What it hinders works again: [s] that it lasted, if it has ended now."""
        if name not in self._began or now - self._last[name] < PEACE:
            return None
        return self._last[name] - self._began.pop(name)
