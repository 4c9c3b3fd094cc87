"""What bad input gets."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from driven_heat import GRID, ROOM, SECOND, SOURCE, DrivenHeat
from imus import imu
from reached_heat import exploring, navigating
from warm_room import Patch, Room, box

from rover_common.geometry import Pose
from rover_common.sensor_types import LaserScan, ThermalFrame, Twist
from rover_heat.mission.chart import State
from rover_heat.mission.ownership import STAND
from rover_navigation.navigator import GoalStatus

WARM = Room(box(4.0, 4.0), (Patch(wall=2, along=2.0),))  # to the north
BEFORE = Pose(2.0, 3.2, math.pi / 2)  # the warm place


def sensing_of(driven: DrivenHeat):
    return driven.mission.parts.sensing


def warm_frames(driven: DrivenHeat, sensors=(2,), change=None) -> dict:
    """A tick's thermal frames before the warm place; the others see nothing warm."""
    if driven._count % 2:
        return {}
    stamp = round(driven.time * SECOND)
    values = {1: WARM.celsius(driven.pose, 1.5184), 2: WARM.celsius(driven.pose, 0.0)}
    if change is not None:
        values = {sensor: change(celsius) for sensor, celsius in values.items()}
    return {"thermal": tuple(ThermalFrame(stamp, n, values[n]) for n in sensors)}


def looking(driven: DrivenHeat, seconds: float, **options) -> None:
    for _ in range(round(seconds / 0.05)):
        driven.tick(**warm_frames(driven, **options))


@pytest.fixture
def before() -> DrivenHeat:
    """Standing before a warm place, with heat in no frame so far."""
    driven = exploring()
    driven.move_to(BEFORE)
    driven.ticks(1.0)
    assert sensing_of(driven).fixes == []
    return driven


SCANS = {
    "zeros": lambda ranges: np.where(np.arange(len(ranges)) % 3 == 0, 0.0, ranges),
    "nan": lambda ranges: np.where(np.arange(len(ranges)) % 3 == 0, np.nan, ranges),
    "infinite": lambda ranges: np.where(np.arange(len(ranges)) % 3 == 0, np.inf, ranges),
    "negative infinite": lambda ranges: np.where(np.arange(len(ranges)) % 3 == 0, -np.inf, ranges),
    "a run is missing": lambda ranges: np.where(np.arange(len(ranges)) < 60, 0.0, ranges),
    "nothing": lambda ranges: np.zeros_like(ranges),
}


@pytest.mark.parametrize("broken", SCANS)
def test_rays_that_did_not_come_back_are_nothing(before, broken):
    def scan() -> LaserScan:
        whole = ROOM.scan(BEFORE, round(before.time * SECOND))
        return replace(whole, ranges=SCANS[broken](whole.ranges).astype(np.float32))

    for _ in range(30):
        before.tick(scans=(scan(),), **warm_frames(before))
    assert before.state is State.EXPLORING
    for fix in sensing_of(before).fixes:
        assert math.dist((fix.x, fix.y), (2.0, 4.0)) < 0.1


@pytest.mark.parametrize("first", [0.0, -math.pi])
def test_scans_of_another_length_and_range_of_angles_are_taken_as_described(before, first):
    rng = np.random.default_rng(1)
    for _ in range(30):
        rays = int(rng.integers(180, 461))
        increment = 2.0 * math.pi / (rays - 1)  # the last ray is the first one again
        angles = first + increment * np.arange(rays)
        ranges, _ = ROOM.cast(BEFORE.x, BEFORE.y - 0.032, BEFORE.yaw + angles)
        stamp = round(before.time * SECOND)
        scan = LaserScan(stamp, first, increment, 0.0, 0.16, 8.0, ranges.astype(np.float32))
        before.tick(scans=(scan,), **warm_frames(before))
    fixes = sensing_of(before).fixes
    assert len(fixes) > 5
    assert all(math.dist((fix.x, fix.y), (2.0, 4.0)) < 0.05 for fix in fixes)


def test_a_jump_of_the_pose_stops_it_and_drops_the_last_fixes(before):
    looking(before, 3.0)
    many = len(sensing_of(before).fixes)
    before.pose = replace(BEFORE, y=BEFORE.y - 0.4)
    decisions = before.ticks(0.15)
    assert State.HOLD in {made.state for made in decisions}
    assert many - 12 <= len(sensing_of(before).fixes) <= many - 8
    before.until_state(State.EXPLORING, 1.0)


@pytest.mark.parametrize("orientation", ["none", "zero"])
def test_without_an_orientation_the_interrupt_works(orientation):
    driven = exploring()

    def imus(pitch: float, rate: float) -> tuple:
        stamps = [round(driven.time * SECOND) - step * 10_000_000 for step in (4, 3, 2, 1, 0)]
        return tuple(imu(s, pitch=pitch, rates=(0.0, rate, 0.0), orientation=orientation)
                     for s in stamps)  # fmt: skip

    for _ in range(60):
        driven.tick(imus=imus(0.0, 0.0))
    for step in range(6):
        driven.tick(imus=imus(-0.02 * step, -0.4))
    states = [driven.tick(imus=imus(-0.119, 0.0)).state for _ in range(8)]
    assert State.TILT_INTERRUPT in states


def test_clocks_apart_stop_it_after_a_second_with_that_reason():
    driven = exploring()
    late = 600_000_000  # [ns]

    def apart() -> dict:
        stamp = round(driven.time * SECOND) - late
        return {"scans": (ROOM.scan(driven.pose, stamp),), "imus": (imu(stamp),)}

    states = [driven.tick(**apart()).state for _ in range(30)]
    assert states.index(State.HOLD) == pytest.approx(20, abs=2)
    decision = driven.tick(**apart())
    assert "clock" in decision.reason
    assert decision.twist == STAND
    driven.until_state(State.EXPLORING, 1.0)


def test_a_clock_that_is_a_little_apart_only_shows():
    driven = exploring()
    for _ in range(60):
        stamp = round(driven.time * SECOND) - 300_000_000
        driven.tick(scans=(ROOM.scan(driven.pose, stamp),), imus=(imu(stamp),))
    assert driven.state is State.EXPLORING
    assert driven.mission.parts.inputs.apart == pytest.approx(0.3)


def test_another_map_moves_nothing():
    driven = navigating()
    source = driven.mission.overlay().sources[0]
    stand = driven.goal.pose
    for shift, size in ((-3.0, 200), (1.7, 64), (0.0, 80)):
        cells = np.zeros((size, size), np.int8)
        driven.tick(grid=replace(GRID, origin_x=shift, origin_y=shift, cells=cells))
    after = driven.mission.overlay().sources[0]
    assert (after.x, after.y) == (source.x, source.y) == (SOURCE.x, SOURCE.y)
    assert driven.goal.pose == stand


def test_a_navigator_that_dies_stops_it_and_its_return_drives_to_the_same_goal():
    driven = exploring()
    goal = driven.goal.pose
    driven.navigator.is_ready = False
    decision = driven.until_state(State.HOLD, 0.6)
    assert "navigator" in decision.reason
    assert decision.twist == STAND
    driven.ticks(15.0)
    driven.navigator.is_ready = True
    driven.until_state(State.EXPLORING, 0.5)
    driven.until_goal(goal, 2.0)


def test_a_navigator_that_does_not_come_back_in_20_s_is_a_failure():
    driven = exploring()
    driven.navigator.is_ready = False
    driven.until_state(State.HOLD, 0.6)
    driven.ticks(19.5)
    assert driven.state is State.HOLD
    assert "navigator" in driven.until_state(State.FAILED, 1.0).reason


@pytest.mark.parametrize("reason", ["the goal is in a wall", "the goal is out of the map"])
def test_a_goal_that_is_refused_is_not_given_again_for_a_while(reason):
    driven = exploring()
    driven.goal.status = GoalStatus.FAILED
    driven.navigator.refuses = reason
    driven.ticks(1.0)
    assert any(reason in notice for notice in driven.notices) or len(driven.notices) > 0
    request = driven.mission.plan_request(driven.frame())(None)
    assert len(request.failed) == 1


def test_odometry_that_begins_far_away_is_nothing_to_the_mission():
    driven = exploring()
    decision = driven.tick(twist=Twist(0.0, 0.0))
    assert decision.progress.distance < 1.0
