"""What the mission remembers of goals, sources and ramps."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from driven_heat import SOURCE, STAND
from warm_room import Room, box, hits_of

from rover_common.geometry import Pose
from rover_heat.config import HeatConfig
from rover_heat.mission.back_track import BackTrack, towards
from rover_heat.mission.goal_book import GoalBook
from rover_heat.mission.ramp_book import RampBook
from rover_heat.mission.source_book import SourceBook
from rover_heat.mission.wheel_slip import WheelSlip
from rover_heat.planning.types import GoalKind, HeatGoal, HeatPlan, StandOff
from rover_heat.thermal.fix import View
from rover_heat.tilt import Lean

CONFIG = HeatConfig()
GOAL = HeatGoal(GoalKind.FRONTIER, Pose(1.0, 0.0, 0.0), 1.5, 0.0, 5.0)
AHEAD = Lean(0.0, -0.07)  # a rise ahead
OTHER = replace(SOURCE, x=1.0, y=0.0, normal=math.pi / 2)
ROOM = Room(box(4.0, 4.0))


def plan_of(*sources, seconds=None) -> HeatPlan:
    times = seconds or [8.0] * len(sources)
    stands = tuple((replace(STAND, seconds=time),) for time in times)
    return HeatPlan(0, sources=sources, stand_offs=stands)


def test_a_failed_goal_is_not_chosen_for_60_s_and_after_another_failure_not_at_all():
    book = GoalBook(0.05, 4)
    book.failed(100.0, GOAL)
    assert len(book.not_now(159.0)) == 1
    assert len(book.not_now(161.0)) == 0
    book.failed(161.0, replace(GOAL, x=1.55))  # the same, seen anew
    assert len(book.not_now(1e9)) == 1
    book.forgive(GOAL)
    assert len(book.not_now(200.0)) == 0


def test_a_visited_frontier_makes_known_what_lies_within_four_cells():
    book = GoalBook(0.05, 4)
    book.reached(GOAL)
    assert book.known().tolist() == [[1.5, 0.0, 0.2]]
    book.reached(replace(GOAL, kind=GoalKind.VIEW))
    assert len(book.visited) == 1


def test_a_face_is_given_up_after_two_views_in_vain():
    book = GoalBook(0.05, 4)
    faces = np.array([[1.025, 0.025], [1.075, 0.025]])
    assert len(book.viewed_in_vain(faces)) == 0
    assert book.viewed_in_vain(faces[:1]).tolist() == [[1.025, 0.025]]


def test_a_source_keeps_its_number_when_it_is_seen_better():
    book = SourceBook(CONFIG)
    book.update(plan_of(SOURCE, OTHER))
    numbers = [source.id for source in book.sources]
    book.update(plan_of(OTHER, replace(SOURCE, x=2.1, observations=60)))
    assert [source.id for source in book.sources] == numbers
    assert book.get(numbers[0]).observations == 60


def test_a_source_that_is_none_any_more_is_forgotten_unless_it_was_served():
    book = SourceBook(CONFIG)
    book.update(plan_of(SOURCE, OTHER))
    first, second = (source.id for source in book.sources)
    book.mark_delivered(first)
    book.update(plan_of())
    assert [source.id for source in book.sources] == [first]
    assert book.get(second) is None
    assert book.delivered == 1


def test_the_other_side_of_a_wall_is_another_source():
    book = SourceBook(CONFIG)
    book.update(plan_of(SOURCE))
    book.update(plan_of(SOURCE, replace(SOURCE, normal=math.pi / 2)))
    assert len(book.sources) == 2


def test_the_soonest_reached_source_is_served_first_and_one_in_vain_last():
    book = SourceBook(CONFIG)
    book.update(plan_of(SOURCE, OTHER, seconds=[9.0, 5.0]))
    first = book.next()
    assert (first.x, first.y) == (OTHER.x, OTHER.y)
    for _ in range(3):
        book.failed(first.id)
    assert book.next().id != first.id
    book.mark_delivered(book.next().id)
    assert book.next().id == first.id  # once more at the end
    for _ in range(3):
        book.failed(first.id)
    assert book.next() is None


def test_after_a_pose_in_vain_comes_another_one():
    book = SourceBook(CONFIG)
    poses = [Pose(2.0, 3.7, 1.6), Pose(2.0, 3.65, 1.6)]
    stands = tuple(StandOff(pose, 8.0) for pose in poses)
    book.update(HeatPlan(0, sources=(SOURCE,), stand_offs=(stands,)))
    number = book.next().id
    assert book.stand_off(number).pose == poses[0]
    book.failed(number)
    assert book.stand_off(number).pose == poses[1]


def test_a_source_without_a_stand_off_is_not_served():
    book = SourceBook(CONFIG)
    book.update(HeatPlan(0, sources=(SOURCE,), stand_offs=((),)))
    assert book.next() is None
    assert book.stand_off(1) is None


def test_a_source_is_sure_with_many_fixes_from_near():
    for changed, sure in ({}, True), ({"observations": 9}, False), ({"nearest": 1.5}, False):
        book = SourceBook(CONFIG)
        book.update(plan_of(replace(SOURCE, **changed)))
        assert (book.next(only_sure=True) is not None) == sure


def test_a_source_that_is_cold_from_near_is_dropped():
    pose = Pose(2.0, 3.4, math.pi / 2)
    view = View(0, 2, pose, 0.0, 0.0, hits_of(ROOM, pose))
    warm, cold = np.full(8, 0.3), np.full(8, 0.3)
    warm[3:5] = 6.0
    elsewhere = np.full(8, 0.3)
    elsewhere[0] = 6.0
    book = SourceBook(CONFIG)
    book.update(plan_of(replace(SOURCE, observations=10)))
    assert book.note_views([(view, warm)] * 50) == []
    away = replace(view, pose=Pose(2.0, 3.4, 0.0))
    assert book.note_views([(away, cold)] * 50) == []
    assert book.note_views([(view, elsewhere)] * 10) == []
    (dropped,) = book.note_views([(view, cold)])
    assert (dropped.x, dropped.y) == (SOURCE.x, SOURCE.y)
    assert book.sources == ()


def test_one_foot_met_again_is_one_ramp_and_another_foot_another():
    book = RampBook(1.25)
    book.meet(Pose(1.0, 1.0, 0.0), AHEAD, np.empty((0, 2)))
    book.meet(Pose(1.05, 1.1, 0.1), AHEAD, np.empty((0, 2)))
    assert len(book.ramps) == len(book.hazards.strips) == 1
    assert len(book.hazards.discs) == 2
    book.meet(Pose(2.3, 1.0, math.pi), AHEAD, np.empty((0, 2)))
    assert len(book.ramps) == 2


def test_a_ramp_met_from_its_side_is_marked_and_not_climbed():
    book = RampBook(1.25)
    lane = Room(box(4.0, 1.02))
    pose = Pose(2.0, 0.3, math.pi / 2)
    book.meet(pose, AHEAD, hits_of(lane, pose))
    assert book.ramps == ()
    assert len(book.hazards.discs) == 1
    assert book.best() is None


def test_the_ramp_to_climb_lies_between_walls_and_is_reachable():
    book = RampBook(1.25)
    for x, yaw in ((1.0, 0.0), (2.0, 0.0), (3.0, 0.0)):
        book.meet(Pose(x, 1.0, yaw), AHEAD, np.empty((0, 2)))
    first, second, third = book.ramps
    assert book.best() is None  # before a plan
    book.ramps = (first, replace(second, between=True), replace(third, between=True))
    stands = tuple(StandOff(ramp.before_foot(0.5), 5.0) for ramp in book.ramps)
    book.update(HeatPlan(0, approaches=(stands[0], stands[1], replace(stands[2], seconds=4.0))))
    assert book.best()[0].x == third.x
    book.update(HeatPlan(0, approaches=(*stands[:2], replace(stands[2], seconds=math.inf))))
    assert book.best()[0].x == second.x


def test_the_track_holds_level_poses_only_and_so_many():
    track = BackTrack(20)
    for step in range(100):
        track.update(Pose(0.02 * step, 0.0, 0.0), level=step < 90)
    target = track.targets(Pose(1.98, 0.0, 0.0))[0]
    assert target.x < 1.98 - 0.35
    assert len(track.targets(Pose(9.0, 0.0, 0.0))) == 20
    assert BackTrack(20).targets(Pose(0.0, 0.0, 0.0)) == []


def test_it_backs_with_the_tail_ahead():
    back = towards(Pose(-1.0, 0.0, 0.0), Pose(0.0, 0.0, 0.0))
    assert (back.linear, back.angular) == (-0.10, 0.0)
    assert towards(Pose(1.0, 0.0, 0.0), Pose(0.0, 0.0, 0.0)).linear == 0.10
    aslant = towards(Pose(-1.0, 0.2, 0.0), Pose(0.0, 0.0, 0.0))
    assert aslant.linear < 0.0 > aslant.angular  # the tail swings to the left
    aside = towards(Pose(0.0, 1.0, 0.0), Pose(0.0, 0.0, 0.0))
    assert aside.linear == 0.0 != aside.angular


def test_wheels_that_turn_for_a_second_without_progress_slip():
    def slips(seconds: float, speed: float, moved: float) -> bool:
        slip = WheelSlip()
        for step in range(round(seconds / 0.05)):
            slip.update(0.05 * step, Pose(moved * 0.05 * step, 0.0, 0.0), speed)
        return slip.slips

    assert slips(1.2, 0.2, 0.0)
    assert slips(1.2, -0.2, 0.0)
    assert not slips(0.9, 0.2, 0.0)
    assert not slips(3.0, 0.2, 0.18)
    assert not slips(3.0, 0.0, 0.0)
