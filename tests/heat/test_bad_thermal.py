"""What thermal frames may be like, and what they get."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from driven_heat import MIDDLE, SECOND, DrivenHeat
from reached_heat import exploring
from warm_room import Patch, Room, box

from rover_common.geometry import Pose
from rover_common.sensor_types import ThermalFrame
from rover_heat.config import HeatConfig
from rover_heat.mission.chart import State
from rover_heat.thermal.sensing import SILENT

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


def test_heat_in_two_frames_in_a_row_is_a_fix(before):
    looking(before, 1.0)
    fixes = sensing_of(before).fixes
    assert len(fixes) >= 8
    assert all(math.dist((fix.x, fix.y), (2.0, 4.0)) < 0.05 for fix in fixes)
    assert {fix.sensor for fix in fixes} == {2}


BROKEN = {
    "63 values": lambda celsius: celsius.ravel()[:63],
    "65 values": lambda celsius: np.append(celsius, 20.0),
    "0 values": lambda celsius: np.empty(0),
    "not a number": lambda celsius: np.where(np.eye(8) > 0, np.nan, celsius),
    "outside": lambda celsius: celsius + 200.0,
}


@pytest.mark.parametrize("reason", BROKEN)
def test_a_broken_frame_is_dropped_and_counted(before, reason):
    looking(before, 1.0, change=BROKEN[reason])
    sensing = sensing_of(before)
    assert sensing.fixes == []
    assert sum(sensing.dropped.values()) == 10
    assert any(reason.split()[0] in dropped for dropped in sensing.dropped)


def test_a_frame_that_is_warmer_all_over_than_the_air_is_not_used(before):
    looking(before, 1.0, change=lambda celsius: celsius + 7.0)
    assert sensing_of(before).fixes == []
    looking(before, 1.0, change=lambda celsius: celsius + 5.0)
    assert len(sensing_of(before).fixes) > 5


def test_frames_in_a_cold_room_read_without_their_sign_are_used():
    driven = exploring()
    driven = DrivenHeat()
    cold = np.full((8, 8), -3.0, np.float32) + 512.0
    driven.until_state(State.EXPLORING, 5.0, air=cold)
    driven.move_to(BEFORE, air=cold)
    driven.ticks(1.0, air=cold)

    def unsigned(celsius):
        shifted = celsius - 27.0
        return np.where(shifted < 0.0, shifted + 512.0, shifted)

    looking(driven, 1.0, change=unsigned)
    assert len(sensing_of(driven).fixes) > 5


@pytest.mark.parametrize("flip", ["none", "rows", "columns", "both"])
def test_a_mirrored_sensor_finds_the_same_place(flip):
    driven = exploring(HeatConfig(thermal_flip_2=flip))
    driven.move_to(replace(BEFORE, yaw=math.pi / 2 - 0.2))
    driven.ticks(1.0)

    def mounted(celsius):
        rows, columns = flip in ("rows", "both"), flip in ("columns", "both")
        return celsius[:: -1 if rows else 1, :: -1 if columns else 1]

    looking(driven, 1.0, change=mounted)
    fixes = sensing_of(driven).fixes
    assert len(fixes) > 5
    assert all(math.dist((fix.x, fix.y), (2.0, 4.0)) < 0.1 for fix in fixes)


def test_a_silent_thermal_sensor_is_dead_after_3_s_and_the_other_goes_on(before):
    looking(before, SILENT + 0.2, sensors=(2,))
    assert sensing_of(before).alive == (2,)
    assert before.mission.plan_request(before.frame())(None).sensors == (2,)
    assert before.state is State.EXPLORING
    before.ticks(SILENT + 0.2, thermal=())
    assert sensing_of(before).alive == ()
    assert before.state is State.EXPLORING


def test_heat_at_the_images_border_leaves_the_walls_in_it_open():
    """The patch is cut, so that it gives no fix; what is left of the image examines nothing."""
    driven = exploring()
    coverage = sensing_of(driven).coverage
    faces = np.stack([np.linspace(1.8, 2.2, 9), np.full(9, 3.97)], axis=1)
    driven.move_to(replace(BEFORE, yaw=math.pi / 2 - math.radians(26.0)), thermal=())
    driven.ticks(0.5, thermal=())
    looking(driven, 1.0)
    assert sensing_of(driven).is_warm
    assert sensing_of(driven).fixes == []
    assert coverage.examined_from(BEFORE.x, BEFORE.y, faces) == 0.0
    driven.move_to(BEFORE, thermal=())
    driven.ticks(0.5, thermal=())
    looking(driven, 1.0)
    assert len(sensing_of(driven).fixes) > 5
    assert coverage.examined_from(BEFORE.x, BEFORE.y, faces) == 1.0


def test_a_turning_robot_makes_no_fix(before):
    for _ in range(20):
        before.tick(turn=0.35, **warm_frames(before))
    assert sensing_of(before).fixes == []


def test_a_tilted_robot_makes_no_fix(before):
    before.ticks(0.5, pitch=-0.053)
    for _ in range(40):
        before.tick(pitch=-0.053, **warm_frames(before))
    assert sensing_of(before).fixes == []


def test_the_pose_of_the_frames_time_counts(before):
    """The robot has turned away since: the fix lies where it looked then."""
    config = HeatConfig(thermal_delay=0.2)
    driven = exploring(config)
    driven.move_to(BEFORE)
    driven.ticks(1.0)

    class Past:
        def pose_at(self, stamp: int) -> Pose:
            late = stamp > round((driven.time - 0.15) * SECOND)
            return replace(BEFORE, yaw=BEFORE.yaw - 0.3) if late else BEFORE

    for _ in range(20):
        driven.tick(poses=Past(), **warm_frames(driven))
    fixes = sensing_of(driven).fixes
    assert len(fixes) > 5
    assert all(math.dist((fix.x, fix.y), (2.0, 4.0)) < 0.05 for fix in fixes)


def test_a_stuck_pixel_makes_no_source():
    driven = exploring()

    def stuck(celsius):
        celsius = np.array(celsius)
        celsius[3, 4] = 45.0
        return celsius

    cold = Room(box(4.0, 4.0))
    for step in range(200):
        driven.pose = replace(MIDDLE, yaw=0.01 * step)
        stamp = round(driven.time * SECOND)
        frame = ThermalFrame(stamp, 2, stuck(cold.celsius(driven.pose, 0.0)))
        driven.tick(turn=0.2, thermal=(frame,))
    assert sensing_of(driven).fixes == []
