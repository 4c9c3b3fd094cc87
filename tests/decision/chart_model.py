"""The chart as a plain relation, so that it can be walked through, and mutated."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import Enum, auto

from rover_decision.missions.sample_return.chart import Event, State, Transition

EXPLORING = frozenset({State.FORWARD, State.STOP, State.ROCK_APPROACH, State.CIRCLE})


class Phase(Enum):
    """What an interruption returns to."""

    EXPLORING = auto()
    HEADING_HOME = auto()


@dataclass(frozen=True)
class Configuration:
    """Where a mission is in the chart."""

    state: State
    phase: Phase = Phase.EXPLORING


START = Configuration(State.IDLE)


class ChartModel:
    """Walks along a relation; where an event leads to both phases, it returns to the present one.

    Raises ValueError where an event leads to two states of one phase.
    """

    def __init__(self, relation: Iterable[Transition]) -> None:
        self._targets: dict[tuple[State, Event], set[State]] = {}
        self._paths: dict[Configuration, dict[Configuration, tuple[Event, ...]]] = {}
        for arrow in relation:
            self._targets.setdefault((arrow.source, arrow.event), set()).add(arrow.target)

    def after(self, at: Configuration, *events: Event) -> Configuration:
        """Where events lead to, one after the other; an unknown one changes nothing."""
        for event in events:
            at = self._step(at, event)
        return at

    def state_after(self, at: Configuration, *events: Event) -> State:
        return self.after(at, *events).state

    def paths(self, start: Configuration = START) -> dict[Configuration, tuple[Event, ...]]:
        """All configurations within reach, and the shortest sequence of events to each."""
        if start in self._paths:
            return self._paths[start]
        paths: dict[Configuration, tuple[Event, ...]] = {start: ()}
        queue = deque([start])
        while queue:
            at = queue.popleft()
            for event in Event:
                then = self._step(at, event)
                if then not in paths:
                    paths[then] = (*paths[at], event)
                    queue.append(then)
        self._paths[start] = paths
        return paths

    def _step(self, at: Configuration, event: Event) -> Configuration:
        targets = self._targets.get((at.state, event))
        if targets is None:
            return at
        if len(targets) > 1:
            exploring = at.phase is Phase.EXPLORING
            targets = {target for target in targets if (target in EXPLORING) == exploring}
        (state,) = targets
        if state in EXPLORING:
            return Configuration(state, Phase.EXPLORING)
        if state is State.RETURN_HOME:
            return Configuration(state, Phase.HEADING_HOME)
        return Configuration(state, at.phase)


Mutation = tuple[str, frozenset[Transition]]


def mutations(relation: Iterable[Transition]) -> Iterator[Mutation]:
    """Each arrow dropped, and led to each other state; each arrow that there is not, added.

    With what is wrong about it.
    """
    arrows = frozenset(relation)
    for arrow in sorted(arrows, key=str):
        rest = arrows - {arrow}
        name = f"{arrow.source.name} --{arrow.event.name}-> {arrow.target.name}"
        yield f"{name} dropped", rest
        for target in State:
            if target is not arrow.target:
                led = Transition(arrow.event, arrow.source, target)
                yield f"{name} led to {target.name}", rest | {led}
    known = {(arrow.source, arrow.event) for arrow in arrows}
    for source in State:
        for event in Event:
            for target in State:
                if (source, event) not in known and target is not source:
                    name = f"{source.name} --{event.name}-> {target.name} added"
                    yield name, arrows | {Transition(event, source, target)}
