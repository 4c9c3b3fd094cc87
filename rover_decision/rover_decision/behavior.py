"""What every mission's states are: objects with questions that are asked once per tick."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Generic, TypeVar

TickT = TypeVar("TickT")
StateT = TypeVar("StateT")
EventT = TypeVar("EventT")
ActionT = TypeVar("ActionT")


class Behavior(ABC, Generic[TickT, StateT, EventT, ActionT]):
    """What the robot does in one state, and what lasts from frame to frame there.

    Only `enter` and `update` may change it: `event` and `act` are questions, with the same answers
    when asked twice.
    """

    recoveries = 0  # manoeuvres begun in this state

    def enter(self, tick: TickT, before: StateT) -> None:
        """The state begins at this frame."""

    def update(self, tick: TickT) -> None:
        """A later frame has come in this state."""

    @abstractmethod
    def event(self, tick: TickT) -> EventT | None:
        """What happened, None when all goes on as it is."""

    @abstractmethod
    def act(self, tick: TickT) -> ActionT:
        """The command for this frame, and why."""
