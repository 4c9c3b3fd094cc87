"""How many cases the property tests of the entrances try.

Few with the suite; many by the environment: `FUZZ_CASES=5000 python -m pytest tests/entrances`.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, settings

CASES = int(os.environ.get("FUZZ_CASES", "100"))  # of a test of pure functions
SEQUENCES = max(3, CASES // 8)  # of messages that one node hears
MANY = CASES > 1000


def fuzzed(cases: int = CASES) -> Callable[[Any], Any]:
    """Settings of a property test; the suite repeats the same cases, a long run draws new ones."""
    return settings(
        max_examples=cases,
        deadline=None,
        derandomize=not MANY,
        database=None,
        suppress_health_check=list(HealthCheck),
    )
