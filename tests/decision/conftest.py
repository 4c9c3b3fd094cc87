"""Fixtures of the decision tests."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from cores import CoreBench


@pytest.fixture
def make_bench() -> Iterator[Callable[..., CoreBench]]:
    """Makes cores under test, which end with the test."""
    benches: list[CoreBench] = []

    def make(*arguments: object, **options: object) -> CoreBench:
        benches.append(CoreBench(*arguments, **options))
        return benches[-1]

    yield make
    for bench in benches:
        bench.close()


@pytest.fixture(params=[True, False], ids=["lockstep", "live"])
def lockstep(request) -> bool:
    return request.param


@pytest.fixture
def bench(make_bench, lockstep) -> CoreBench:
    """A core under test, in both modes."""
    return make_bench(lockstep)
