"""Cores that go on with a mission: in a maze to its end, and not at all with what is no memory."""

from __future__ import annotations

import math

import pytest
from heat_lane import lane
from restarted_heat import eventful, kept

from burger_simulator.simulation import BurgerSimulation
from rover_common.types import FIRST_RUN
from rover_heat.config import HeatConfig
from rover_heat.mission import memory_of, resume
from rover_heat.mission.chart import State
from rover_navigation.navigator_config import NavigatorConfig
from rover_tools.evaluation.heat_loop import HeatLoop


@pytest.mark.parametrize("spoil", ["values", "arrays", "number", "fixes", "trail", "pixel"])
def test_a_memory_that_is_none_changes_nothing(spoil):
    loop = HeatLoop(BurgerSimulation(lane(), 1))
    try:
        driven = eventful()
        values, arrays = kept(driven.mission.memory())
        known = values["parts"]["places"]["known"]
        if spoil == "values":
            del known["goals"]
        elif spoil == "arrays":
            arrays = {}
        elif spoil == "number":
            known["sources"]["next"] = "many"
        elif spoil == "fixes":
            arrays["parts.places.thermal.numbers"] = arrays["parts.places.thermal.numbers"][:0]
        elif spoil == "trail":
            arrays["parts.places.driven.trail"] = arrays["parts.places.driven.trail"].ravel()
        else:
            values["parts"]["robot"]["thermal"]["1"]["stuck"] = [[3, 99]]
        before = loop.core.mission
        with pytest.raises((ValueError, TypeError, KeyError)):
            resume(loop.core, driven.config, loop.navigator, FIRST_RUN, (values, arrays))
        assert loop.core.mission is before
    finally:
        loop.close()


@pytest.mark.parametrize("seconds", [14.0, 42.0, 63.0], ids=["launching", "tilted", "on the ramp"])
def test_a_whole_mission_goes_on_with_other_objects(seconds):
    """Navigator and mission are killed at once, at any time of it."""
    simulation, config = BurgerSimulation(lane(), 3), HeatConfig(deliver="at_once")
    settings = NavigatorConfig(samples=100)
    loop = HeatLoop(simulation, config, settings, 5)
    while loop.simulation.truth.time < seconds:
        loop.step()
    mission, navigator = kept(memory_of(loop.core)), kept(loop.navigator.memory()())
    before, done_before = loop.core.mission.overlay(), len(simulation.truth.launches)
    loop.close()
    loop = HeatLoop(simulation, config, settings, 5)
    loop.navigator.restore(navigator)
    resume(loop.core, config, loop._goals, FIRST_RUN, mission)
    try:
        first = loop.step()
        assert first.decision.state is State.INITIALIZING
        assert loop.grid is not None
        result = loop.run(200.0)
    finally:
        loop.close()
    assert result.done
    assert len(result.truth.launches) == 2 >= done_before
    assert result.decision.progress.payloads == 2
    assert result.decision.progress.sources_delivered == 1
    assert result.decision.progress.ramp_done
    assert result.decision.progress.elapsed == pytest.approx(result.truth.time - 1.05, abs=0.1)
    (source,) = (each for each in result.overlay.sources if each.delivered)
    assert source.id == 1
    assert math.dist((source.x, source.y), (before.sources[0].x, before.sources[0].y)) < 0.1
    assert result.overlay.hazards.strips[: len(before.hazards.strips)] == before.hazards.strips
