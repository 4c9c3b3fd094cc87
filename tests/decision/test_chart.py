"""The chart: its rules, and that no fault in one of its arrows would pass unseen."""

from __future__ import annotations

import chart_rules
import pytest
from chart_model import ChartModel, Phase, mutations
from chart_rules import RULES, Rule
from rover_interfaces.msg import MissionState

from rover_decision.missions.sample_return.chart import (
    Event,
    Machine,
    MissionChart,
    State,
    Transition,
    transitions,
)

CHART = ChartModel(transitions())
PATHS = CHART.paths()


def is_broken(rule: Rule, chart: ChartModel) -> bool:
    """Whether a rule does not hold, or cannot even be asked."""
    try:
        return not rule(chart)
    except ValueError:
        return True


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_a_rule_holds(rule):
    assert rule(CHART)


@pytest.mark.parametrize("at", PATHS, ids=lambda at: f"{at.state.name}-{at.phase.name}")
def test_the_model_walks_as_the_machine_does(at):
    for event in Event:
        machine = Machine()
        for step in PATHS[at]:
            machine.handle(step)
        assert machine.state is at.state
        changed = machine.handle(event)
        then = CHART.after(at, event)
        assert machine.state is then.state
        assert changed == (then.state is not at.state)
        assert machine.heading_home == (then.phase is Phase.HEADING_HOME)


def test_no_mutation_of_an_arrow_survives():
    survivors = [
        name
        for name, relation in mutations(transitions())
        if not any(is_broken(rule, chart) for chart in [ChartModel(relation)] for rule in RULES)
    ]
    assert survivors == []


@pytest.mark.parametrize(
    ("event", "source", "wrong"),
    [
        (Event.picked_up, State.PICKUP, State.STOP),
        (Event.pickup_failed, State.PICKUP, State.STUCK),
        (Event.resume, State.PAUSED, State.RETURN_HOME),
        (Event.inputs_restored, State.HOLD, State.STOP),
    ],
)
def test_an_interruption_that_returned_elsewhere_would_be_found(event, source, wrong):
    right = Transition(event, source, State.FORWARD)
    assert right in transitions()
    mutated = transitions() - {right} | {Transition(event, source, wrong)}
    rule = chart_rules.an_interruption_returns_to_the_phase_that_it_interrupted
    assert is_broken(rule, ChartModel(mutated))


def test_states_are_those_of_the_message():
    for state in State:
        assert getattr(MissionState, state.name) == state.value


def test_the_chart_knows_each_event_and_no_other():
    assert {event.id for event in MissionChart.events} == {event.name for event in Event}
