"""How long to wait so that a rate is kept: a token bucket."""

from __future__ import annotations


class TokenBucket:
    """Fills at `rate` [1/s] up to `burst`; what is taken beyond is waited for."""

    def __init__(self, rate: float, burst: float) -> None:
        self._rate = rate
        self._burst = burst
        self._tokens = burst
        self._filled = 0.0  # [s] when it was last filled

    def take(self, now: float, cost: float = 1.0) -> float:
        """Take `cost` tokens at `now` [s]; the seconds to wait until they are there."""
        elapsed = max(0.0, now - self._filled)
        self._tokens = min(self._burst, self._tokens + elapsed * self._rate) - cost
        self._filled = max(now, self._filled)
        return max(0.0, -self._tokens / self._rate)
