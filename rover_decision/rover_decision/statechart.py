"""A mission's statechart behind one seam: a current state, and events that lead to another.

A chart is declared with python-statemachine; its leaf states have the values of the mission's state
enumeration, and its events the names of the mission's event enumeration.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum, IntEnum
from typing import Generic, TypeVar

from statemachine import State as ChartState
from statemachine import StateChart

StateT = TypeVar("StateT", bound=IntEnum)
EventT = TypeVar("EventT", bound=Enum)


class StateMachine(Generic[StateT, EventT]):
    """Where a mission is in its chart."""

    def __init__(self, chart: type[StateChart], states: type[StateT]) -> None:
        self._chart = chart()
        self._states = states
        self.state = self._present()

    def handle(self, event: EventT) -> bool:
        """Whether the event led to another state."""
        before = self.state
        self._chart.send(event.name)
        self.state = self._present()
        return self.state is not before

    @property
    def active(self) -> set[str]:
        """Names of the present state and of all groups around it."""
        return {state.id for state in self._chart.configuration}

    def interrupted(self, history: str) -> set[str]:
        """Names of what a history state would return to; empty when nothing was left yet."""
        return {state.id for state in self._chart.history_values.get(history, ())}

    def _present(self) -> StateT:
        values = (state.value for state in self._chart.configuration)
        (state,) = (value for value in values if isinstance(value, self._states))
        return state


@dataclass(frozen=True)
class Transition(Generic[StateT, EventT]):
    """One arrow of a chart, between states that a robot can be in."""

    event: EventT
    source: StateT
    target: StateT


def transitions(
    chart: type[StateChart], events: type[EventT], states: type[StateT]
) -> set[Transition[StateT, EventT]]:
    """All arrows, those of the groups and of the history taken apart."""
    found = set()
    for source in _leaves(chart.states):
        for group in (source, *source.ancestors()):
            for transition in group.transitions:
                for event in transition.events:
                    for target in _entered(transition.target):
                        leaf = states(source.value), states(target.value)
                        found.add(Transition(events[event.id], *leaf))
    return found


def _leaves(states: Iterable[ChartState]) -> list[ChartState]:
    return [leaf for state in states for leaf in (_leaves(state.states) or [state])]


def _entered(state: ChartState) -> list[ChartState]:
    """The states that a transition to this one may lead to."""
    if state.is_history:
        phases = state.parent.states if state.parent else []
        return [leaf for phase in phases for leaf in _entered(phase)]
    if not state.states:
        return [state]
    return [leaf for child in state.states if child.initial for leaf in _entered(child)]
