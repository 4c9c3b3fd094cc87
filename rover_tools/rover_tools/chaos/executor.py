"""Lets the faults of a plan come, one after the other, and watches what each of them does."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from rover_tools.chaos.losses import Loss
from rover_tools.chaos.plan import Fault

PATIENCE = 60.0  # [s] of wall time until all nodes are at work again

End = Callable[[], None]
Begin = Callable[[Fault], End]  # makes a fault come; returns what ends it


class Mission(Protocol):
    """What an executor knows of the mission."""

    def mark(self) -> None:
        """From here on `recovered` looks for new work of all nodes."""

    def recovered(self) -> bool:
        """Whether all nodes have worked since the mark."""

    def losses(self) -> list[Loss]:
        """What was lost since the last question."""


@dataclass
class Outcome:
    """What became of a fault."""

    fault: Fault
    began: float  # [s] of wall time since the faults began
    ended: float = 0.0  # [s]
    recovered: float | None = None  # [s] from its end until all nodes were at work; None for never
    losses: list[Loss] = field(default_factory=list)


class Executor:
    """Called often by the loop that runs the mission."""

    def __init__(
        self,
        faults: Iterable[Fault],
        begin: Begin,
        mission: Mission,
        told: Callable[[Outcome], None] = lambda outcome: None,
    ) -> None:
        """told: called once for each fault, when its outcome is known."""
        self._faults = list(reversed(list(faults)))
        self._begin = begin
        self._mission = mission
        self._told = told
        self._end: End | None = None  # of the fault in force
        self._waiting: Outcome | None = None  # in force, or not recovered yet
        self._outcomes: list[Outcome] = []
        self._start: float | None = None

    @property
    def outcomes(self) -> Sequence[Outcome]:
        """Of all faults that came."""
        return self._outcomes

    def tick(self, clock: float) -> None:
        """clock [s] of wall time; the plan begins with the first call."""
        now = self._since_start(clock)
        if self._waiting is None:
            self._begin_when_due(now)
        elif self._end is not None:
            self._end_when_due(self._waiting, now)
        else:
            self._settle_when_recovered(self._waiting, now)

    def close(self, clock: float) -> None:
        """The mission is over: end the fault in force; no other one comes."""
        now = self._since_start(clock)
        self._faults.clear()
        if self._end is not None and self._waiting is not None:
            self._end_now(self._waiting, now)
        if self._waiting is not None:
            self._settle(self._waiting)

    def _since_start(self, clock: float) -> float:
        if self._start is None:
            self._start = clock
        return clock - self._start

    def _begin_when_due(self, now: float) -> None:
        if self._faults and now >= self._faults[-1].at:
            fault = self._faults.pop()
            self._waiting = Outcome(fault, now)
            self._outcomes.append(self._waiting)
            self._end = self._begin(fault)

    def _end_when_due(self, outcome: Outcome, now: float) -> None:
        if now >= outcome.began + outcome.fault.seconds:
            self._end_now(outcome, now)

    def _end_now(self, outcome: Outcome, now: float) -> None:
        assert self._end is not None
        self._end()
        self._end = None
        outcome.ended = now
        self._mission.mark()

    def _settle_when_recovered(self, outcome: Outcome, now: float) -> None:
        if self._mission.recovered():
            outcome.recovered = now - outcome.ended
        elif now < outcome.ended + PATIENCE:
            return
        else:
            text = f"after {PATIENCE:.0f} s not all nodes were at work"
            outcome.losses.append(Loss("recovery", text))
        self._settle(outcome)

    def _settle(self, outcome: Outcome) -> None:
        outcome.losses += self._mission.losses()
        self._waiting = None
        self._told(outcome)
