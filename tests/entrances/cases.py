"""How many cases the property tests of the entrances try, and how fast they went.

The suite tries few, always the same. A long run draws new ones and tells their rate:

    FUZZ_CASES=100000 FUZZ_SEQUENCES=200 FUZZ_WIRE_CASES=5000 python -m pytest tests/entrances
"""

from __future__ import annotations

import functools
import os
from collections import Counter
from collections.abc import Callable
from typing import Any

from hypothesis import HealthCheck, settings

CASES = int(os.environ.get("FUZZ_CASES", "500"))  # of pure functions, all tests together
SEQUENCES = int(os.environ.get("FUZZ_SEQUENCES", "2"))  # of all topics, for each node
WIRE_CASES = int(os.environ.get("FUZZ_WIRE_CASES", "50"))  # telemetries over a socket
LONG = CASES > 500 or SEQUENCES > 3 or WIRE_CASES > 50
TALLY: Counter[str] = Counter()  # cases by test


def fuzzed(cases: float) -> Callable[[Any], Any]:
    """Settings of a property test, of which each case is counted."""

    def decorate(test: Any) -> Any:
        inner = test.hypothesis.inner_test

        @functools.wraps(inner)
        def counted(*args: Any, **kwargs: Any) -> None:
            TALLY[os.environ["PYTEST_CURRENT_TEST"].split(" ")[0]] += 1
            inner(*args, **kwargs)

        test.hypothesis.inner_test = counted
        return settings(
            max_examples=max(10, round(cases)),
            deadline=None,
            derandomize=not LONG,
            database=None,
            suppress_health_check=list(HealthCheck),
        )(test)

    return decorate
