"""How perception runs the stages of its pipeline: the seam for a measurement of each stage."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, Protocol, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


class StageRunner(Protocol):
    """Calls a stage with its arguments and returns its value; `name` tells stages apart."""

    def __call__(
        self, name: str, stage: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs
    ) -> T: ...


def run_stage(name: str, stage: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> T:
    """The runner of the node: no more than the call."""
    return stage(*args, **kwargs)
