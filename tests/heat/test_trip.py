"""Goals of the navigator: each status, each deadline, and who owns the velocity."""

from __future__ import annotations

import pytest
from driven_heat import FakeNavigator

from rover_common.geometry import Pose
from rover_common.sensor_types import Twist
from rover_heat.mission.ownership import STAND, STOPPED, CommandOwner
from rover_heat.mission.trip import Trip, TripStatus
from rover_navigation.navigator import GoalStatus

GOAL, OTHER = Pose(1.0, 0.0, 0.0), Pose(2.0, 0.0, 0.0)
FORWARD = Twist(0.1, 0.0)


class Driven:
    """A trip that is told the time."""

    def __init__(self) -> None:
        self.navigator = FakeNavigator()
        self.trip = Trip(self.navigator)
        self.time = 0.0

    def start(self, goal: Pose = GOAL, planned: float = 10.0) -> None:
        self.trip.start(goal, 0.1, planned)
        self.wait(0.1)

    def wait(self, seconds: float, drives: bool = True, **handle: float) -> TripStatus:
        for name, value in handle.items():
            setattr(self.navigator.goals[-1], name, value)
        for _ in range(round(seconds / 0.05)):
            self.time += 0.05
            self.trip.update(self.time, drives)
        return self.trip.status


@pytest.mark.parametrize(
    ("status", "expected"),
    [
        (GoalStatus.ACCEPTED, TripStatus.DRIVING),
        (GoalStatus.DRIVING, TripStatus.DRIVING),
        (GoalStatus.REACHED, TripStatus.REACHED),
        (GoalStatus.FAILED, TripStatus.FAILED),
        (GoalStatus.CANCELLED, TripStatus.DRIVING),  # by somebody else: it is driven again
    ],
)
def test_only_reached_is_an_arrival(status, expected):
    driven = Driven()
    driven.start()
    assert driven.wait(0.1, status=status) is expected


def test_a_goal_waits_until_the_navigator_may_drive_and_is_ready():
    driven = Driven()
    driven.trip.start(GOAL, 0.1, 10.0)
    assert driven.wait(1.0, drives=False) is TripStatus.WAITING
    driven.navigator.is_ready = False
    assert driven.wait(1.0) is TripStatus.WAITING
    assert driven.navigator.goals == []
    driven.navigator.is_ready = True
    assert driven.wait(0.1) is TripStatus.DRIVING
    assert driven.navigator.goals[0].pose == GOAL


def test_our_own_newer_goal_is_no_failure():
    driven = Driven()
    driven.start()
    driven.start(OTHER)
    first, second = driven.navigator.goals
    assert first.status is GoalStatus.CANCELLED
    assert (driven.trip.status, driven.trip.goal) == (TripStatus.DRIVING, OTHER)
    assert second.pose == OTHER


@pytest.mark.parametrize("drives", [True, False])
def test_what_the_navigator_still_drives_to_ends_with_the_goal_that_is_to_replace_it(drives):
    driven = Driven()
    driven.start()
    driven.trip.start(OTHER, 0.1, 10.0)
    if drives:
        driven.trip.cancel()
    else:
        driven.trip.update(driven.time, False)
    assert [goal.status for goal in driven.navigator.goals] == [GoalStatus.CANCELLED]


def test_a_goal_that_somebody_else_cancels_is_driven_again_some_times():
    driven = Driven()
    driven.start()
    for _ in range(3):
        assert driven.wait(0.2, status=GoalStatus.CANCELLED) is TripStatus.DRIVING
    assert driven.wait(0.2, status=GoalStatus.CANCELLED) is TripStatus.FAILED
    assert {goal.pose for goal in driven.navigator.goals} == {GOAL}


def test_a_refused_goal_has_failed_at_once_with_its_reason():
    driven = Driven()
    driven.navigator.refuses = "in a wall"
    driven.start()
    assert (driven.trip.status, driven.trip.reason) == (TripStatus.FAILED, "in a wall")


def test_a_goal_that_comes_no_nearer_is_given_up_after_15_s():
    driven = Driven()
    driven.start(planned=100.0)
    assert driven.wait(14.5) is TripStatus.DRIVING
    assert driven.wait(1.0) is TripStatus.FAILED
    assert driven.navigator.goals[-1].status is GoalStatus.CANCELLED
    assert "nearer" in driven.trip.reason


def test_recoveries_and_five_centimetres_count_as_nearer():
    driven = Driven()
    driven.start(planned=100.0)
    driven.wait(20.0, recovering=True)
    driven.wait(0.1, recovering=False)
    for left in (1.9, 1.8, 1.7):
        assert driven.wait(10.0, distance_left=left) is TripStatus.DRIVING
    assert driven.wait(16.0, distance_left=1.66) is TripStatus.FAILED


def test_a_goal_is_given_up_after_three_times_the_planned_time_and_ten_seconds():
    driven = Driven()
    driven.start(planned=2.0)
    for step in range(15):
        assert driven.wait(1.0, distance_left=1.9 - 0.1 * step) is TripStatus.DRIVING
    assert driven.wait(1.5, distance_left=0.3) is TripStatus.FAILED
    assert driven.trip.reason == "later than planned"


def test_an_interrupted_goal_is_given_again():
    driven = Driven()
    driven.start()
    driven.trip.interrupt()
    assert driven.navigator.goals[0].status is GoalStatus.CANCELLED
    assert driven.wait(0.1, drives=False) is TripStatus.WAITING
    assert driven.wait(0.1) is TripStatus.DRIVING
    assert [goal.pose for goal in driven.navigator.goals] == [GOAL, GOAL]
    driven.trip.cancel()
    assert driven.wait(1.0) is TripStatus.NONE


def test_zero_is_sent_for_half_a_second_at_each_change_of_the_owner():
    owner = CommandOwner()
    assert owner.command(0.0, STAND) == STAND
    sent = [owner.command(1.0 + 0.05 * step, None) for step in range(12)]
    assert sent.index(None) == round(STOPPED / 0.05)
    assert set(sent[:10]) == {STAND}
    assert owner.navigator_drives(1.6)
    sent = [owner.command(2.0 + 0.05 * step, FORWARD) for step in range(12)]
    assert sent.index(FORWARD) == round(STOPPED / 0.05)
    assert not owner.navigator_drives(3.0)


def test_nothing_is_sent_against_the_owner():
    owner = CommandOwner()
    owner.command(0.0, None)
    assert {owner.command(1.0 + 0.05 * step, None) for step in range(100)} == {None}
