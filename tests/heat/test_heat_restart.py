"""A heat mission that goes on knows what it knew: places, payloads, time, and its phase."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from driven_heat import RAMP_PITCH, SOURCE, STAND, DrivenHeat
from reached_heat import (
    at_ramp,
    done,
    explored_plan,
    exploring,
    failed,
    interrupted,
    launching,
    navigating,
    paused,
    returning,
)
from restarted_heat import AHEAD, again, eventful, request_of

from rover_decision.types import Request
from rover_heat.mission.chart import State
from rover_heat.mission.parts import SEQUENCE_SECONDS
from rover_heat.planning.types import HeatPlan


def test_an_eventful_mission_goes_on_with_all_that_its_plans_are_made_of():
    driven = eventful()
    other = again(driven, seconds=0.0)
    before, after = request_of(driven), request_of(other)
    assert min(len(before[each]) for each in ("ramps", "fixes", "failed", "known")) > 0
    assert before["hazards"].discs
    assert len(before["trail"]) > 10
    assert len(before["keys"]) >= 2
    assert after == before | {"sensors": ()}  # none has spoken yet


def test_sources_payloads_time_and_distance_go_on():
    driven = eventful()
    before = driven.tick().progress
    other = again(driven)
    after = other.until_state(State.EXPLORING, 3.0).progress
    assert (after.sources_known, after.sources_delivered, after.payloads) == (1, 1, 3)
    assert after.distance == before.distance > 1.0
    assert after.elapsed == pytest.approx(before.elapsed + 3.0, abs=0.5)
    assert other.mission.overlay().sources == driven.mission.overlay().sources


def test_level_and_air_are_not_measured_again():
    driven = DrivenHeat()
    driven.until_state(State.EXPLORING, 5.0, pitch=0.04)  # on ground that is not level
    other = again(driven)
    other.until_state(State.EXPLORING, 0.3, pitch=0.04)
    one, two = (each.mission.parts for each in (driven, other))
    assert two.tilt.lean.slope < 0.01
    first = one.sensing.memory()["1"]["medians"]
    assert two.sensing.memory()["1"]["medians"][: len(first)] == first


@pytest.mark.parametrize(
    ("reached", "after"),
    [
        (exploring, State.EXPLORING),
        (lambda: interrupted(exploring()), State.EXPLORING),
        (navigating, State.GOAL_NAVIGATION),
        (at_ramp, State.ATTEMPTING_RAMP),
        (returning, State.RETURNING),
    ],
)
def test_it_goes_back_to_what_is_next(reached: Callable[[], DrivenHeat], after: State):
    other = again(reached())
    assert other.tick().state in (State.INITIALIZING, State.EXPLORING)
    other.until_state(after, 2.0)


@pytest.mark.parametrize(
    ("reached", "state"),
    [(done, State.DONE), (failed, State.FAILED), (lambda: paused(exploring()), State.PAUSED)],
)
def test_a_mission_that_stays_where_it_is_does_so(reached: Callable[[], DrivenHeat], state: State):
    driven = reached()
    reason = driven.tick().reason
    other = again(driven)
    decisions = other.ticks(3.0)
    assert {made.state for made in decisions} == {state}
    assert {made.reason for made in decisions} == {reason}
    if state is not State.DONE:
        assert other.mission.request(Request.RESUME)
        other.until_state(State.EXPLORING, 3.0)


class TestPayloads:
    """What was signalled is never signalled again."""

    def signalled(self) -> DrivenHeat:
        driven = launching()
        driven.until(lambda made: made.launch, 5.0)
        return driven

    def test_the_memory_of_the_tick_itself_knows_of_it(self):
        other = again(self.signalled())
        other.launches = 0
        decisions = other.ticks(30.0)
        assert other.launches == 0
        assert decisions[-1].progress.payloads == 3
        assert decisions[-1].progress.sources_delivered == 1

    def test_the_robot_stands_until_the_launcher_has_reported(self):
        other = again(self.signalled(), seconds=1.0)
        decisions = other.ticks(5.0)
        assert {made.state for made in decisions} == {State.INITIALIZING}
        assert decisions[-1].reason == "waits for launcher"
        other.tick(launches_done=1)
        other.until_state(State.ATTEMPTING_RAMP, 1.0)

    def test_or_for_as_long_as_a_sequence_takes(self):
        other = again(self.signalled(), seconds=1.0)
        other.ticks(SEQUENCE_SECONDS - 2.0)
        assert other.state is State.INITIALIZING
        other.until_state(State.ATTEMPTING_RAMP, 2.0)


class TestAnotherMap:
    """Places are void in it, what is of the robot is not."""

    def test_it_begins_its_places_anew(self):
        driven = eventful()
        before = driven.tick().progress
        other = again(driven, places=False)
        known = request_of(other)
        other.plan = None
        after = other.ticks(1.0)[-1].progress
        assert (after.sources_known, after.sources_delivered, after.ramp_known) == (0, 0, False)
        assert (after.payloads, after.distance) == (before.payloads, before.distance)
        assert after.elapsed > before.elapsed
        assert [len(known[each]) for each in ("fixes", "ramps", "keys", "trail", "known")] == [
            0
        ] * 5
        assert known["start"] is None

    def test_nothing_stays_explored_or_given_up(self):
        driven = returning()
        other = again(driven, places=False)
        other.plan = HeatPlan(0, goals=(AHEAD,))
        other.until_state(State.EXPLORING, 2.0)


def test_a_time_limit_that_was_asked_for_stays():
    driven = exploring()
    driven.mission.limit_time(60.0)
    other = again(driven, seconds=60.0)
    other.until_state(State.DONE, 2.0)
    unlimited = again(exploring(), seconds=60.0)
    unlimited.ticks(2.0)
    assert unlimited.state is State.EXPLORING


def test_a_stand_off_and_its_tries_stay():
    driven = navigating()
    driven.mission.parts.sources.failed(1)
    other = again(driven)
    entry = other.mission.parts.sources._entries[1]
    assert (entry.tries, entry.stands, entry.source.x) == (1, (STAND,), SOURCE.x)


def test_a_source_that_is_found_later_has_a_number_of_its_own():
    driven = navigating()
    other = again(driven)
    other.plan = explored_plan(
        sources=(SOURCE, replace(SOURCE, x=0.5)), stand_offs=((STAND,), (STAND,))
    )
    other.ticks(2.0)
    known = {source.id: source.x for source in other.mission.overlay().sources}
    assert known == {1: SOURCE.x, 2: 0.5}


def test_it_backs_along_the_track_that_it_had_and_counts_on():
    driven = exploring()
    driven.arrive()
    other = again(interrupted(driven))
    other.tick()
    assert other.until_state(State.TILT_INTERRUPT, 1.0, pitch=RAMP_PITCH).progress.interrupts == 2
    made = other.ticks(0.7, pitch=RAMP_PITCH)[-1]
    assert made.twist.linear < 0.0, made.reason
