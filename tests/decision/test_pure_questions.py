"""`event` and `act` are questions: asked twice they answer the same, and change nothing."""

from __future__ import annotations

import pickle
from collections import Counter
from typing import Any

import pytest
from frames_by_hand import CONFIG
from rough_missions import run_rough_mission

from rover_decision.missions.sample_return import planned
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.states import make_states
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action


class AskedTwice(StateBehavior):
    """A state whose questions are asked twice, with all that it knows compared before and after."""

    def __init__(self, state: StateBehavior, asked: Counter[str], name: str) -> None:
        self._state = state
        self._asked = asked
        self._name = name

    @property
    def recoveries(self) -> int:
        return self._state.recoveries

    def enter(self, tick: TickContext, before: State) -> None:
        self._state.enter(tick, before)

    def update(self, tick: TickContext) -> None:
        self._state.update(tick)

    def event(self, tick: TickContext) -> Event | None:
        return self._ask(self._state.event, tick)

    def act(self, tick: TickContext) -> Action:
        return self._ask(self._state.act, tick)

    def _ask(self, question: Any, tick: TickContext) -> Any:
        before = pickle.dumps((vars(self._state), tick))
        first, second = question(tick), question(tick)
        assert pickle.dumps((vars(self._state), tick)) == before, self._name
        assert first == second, self._name
        self._asked[f"{self._name} {question.__name__}"] += 1
        return first


@pytest.mark.parametrize(
    "config",
    [CONFIG, DecisionConfig(way_home="bearing")],
    ids=["tour", "bearing"],
)
def test_questions_change_nothing_over_a_mission(monkeypatch, config):
    asked: Counter[str] = Counter()

    def twice(*arguments: Any) -> dict[State, StateBehavior]:
        states = make_states(*arguments)
        return {state: AskedTwice(each, asked, state.name) for state, each in states.items()}

    monkeypatch.setattr(planned, "make_states", twice)
    run_rough_mission(config, 80.0)
    visited = {name.split()[0] for name in asked}
    assert {"FORWARD", "PICKUP", "TILT", "STUCK", "HOLD", "PAUSED", "RETURN_HOME"} <= visited
    assert min(asked.values()) > 0


@pytest.mark.parametrize("question", ["event", "act"])
def test_a_question_that_changes_something_would_be_found(question):
    class Restless(StateBehavior):
        asked = 0

        def event(self, tick: TickContext) -> Event | None:
            self.asked += 1
            return None

        act = event

    state = AskedTwice(Restless(), Counter(), "RESTLESS")
    with pytest.raises(AssertionError, match="RESTLESS"):
        getattr(state, question)(None)
