"""Which answers to a tick are still missing, and since when."""

from __future__ import annotations

from collections.abc import Iterable

SETTLED = 0.5  # [s] of wall time without a newcomer: all have found each other by then


class Settling:
    """Whether something has stayed the same for a while; once it has, it stays settled."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._since: tuple[object, float] | None = None
        self.done = False

    def settled(self, observed: object, now: float) -> bool:
        """observed: what is there at `now` [s] of any clock that does not fall back."""
        if self._since is None or self._since[0] != observed:
            self._since = observed, now
        self.done = self.done or now - self._since[1] >= self._seconds
        return self.done


class Lockstep:
    """Times are [s] of any clock that does not fall back, stamps [ns]."""

    def __init__(self, peers: Iterable[str], deadline: float) -> None:
        """`peers`: names of those who answer each tick; within `deadline` [s]."""
        self._peers = frozenset(peers)
        self._deadline = deadline
        self._stamp: int | None = None
        self._missing: set[str] = set()
        self._until = 0.0
        self._speakers = 0

    def begin(self, stamp: int, now: float) -> None:
        self._stamp, self._until = stamp, now + self._deadline
        self._missing = set(self._peers)

    def answer(self, peer: str, stamp: int) -> bool:
        """Whether it answers the present tick."""
        if stamp != self._stamp:
            return False
        self._missing.discard(peer)
        return True

    def arrived(self, expected: str) -> None:
        """What was expected besides the answers."""
        self._missing.discard(expected)

    def expect(self, also: str) -> None:
        """Something else is on its way to this tick."""
        self._missing.add(also)

    def follow(self, speakers: int, now: float) -> None:
        """`speakers`: who is there to answer; one who has just come may not know of this tick."""
        if speakers > self._speakers:
            self._until = min(self._until, now + SETTLED)
        self._speakers = speakers

    @property
    def missing(self) -> list[str]:
        return sorted(self._missing)

    def expired(self, now: float) -> bool:
        """Whether something is missing and the deadline is over."""
        return bool(self._missing) and now >= self._until
