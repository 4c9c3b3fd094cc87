"""The map that frames add up to."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scene import (
    BRIGHT_SKY,
    EXACT,
    PERIOD,
    SHADOWED_SAND,
    SKY,
    WALL,
    corridor,
    draw,
    drive,
    frames,
    hall,
    mapped,
)  # fmt: skip

from rover_common.geometry import Pose
from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import CameraFrame
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception


@given(pitch=st.floats(-0.02, 0.02), roll=st.floats(-0.02, 0.02))
@settings(max_examples=10, deadline=None)
def test_a_corridor_is_mapped_at_any_tilt_of_driving(pitch, roll):
    cells = mapped(frames(drive(pitch, roll), corridor))
    navigable = navigable_cells(cells)
    inner = np.zeros_like(navigable)
    inner[97:103, 94:105] = True
    assert navigable[inner].mean() > 0.97
    outside = navigable.copy()
    outside[95:105] = False
    assert outside.sum() == 0


@given(pitch=st.floats(-0.06, 0.06), roll=st.floats(-0.06, 0.06))
@settings(max_examples=10, deadline=None)
def test_a_checkerboard_of_pits_is_mapped_at_any_tilt(pitch, roll):
    """Up to 3.4 degrees: more than braking, throttle and turns tilt the rover by."""

    def board(x, y):
        return ((np.floor(x / 4) + np.floor(y / 4)) % 2 == 0) | (np.abs(y - 100) < 2)

    navigable = navigable_cells(mapped(frames(drive(pitch, roll), board)))
    left, bottom, right, top = 90, 94, 110, 106  # farther off, a pit is one or two rows of pixels
    rows, cols = np.nonzero(navigable[bottom:top, left:right])
    assert len(rows) > 80
    assert board(cols + left + 0.5, rows + bottom + 0.5).mean() > 0.97
    assert navigable[99:101, 94:105].mean() > 0.95


def test_sand_in_shadow_is_ground_and_so_is_the_edge_of_the_shadow():
    def shadowed(x, y):
        return (x > 93) & (y > 98)

    def image(pose):
        picture = draw(pose, hall)
        shadow = draw(pose, lambda x, y: hall(x, y) & shadowed(x, y), SHADOWED_SAND)
        in_shadow = (shadow == SHADOWED_SAND).all(axis=2)
        picture[in_shadow] = SHADOWED_SAND
        return picture

    core = Perception(EXACT)
    for index, pose in enumerate(drive(count=12)):
        core.process(CameraFrame(1 + index * PERIOD, pose, image(pose)))
    assert navigable_cells(core.world_map().cells)[97:103, 94:98].all()


def test_near_observations_outvote_any_number_of_distant_ones():
    """From afar, sand on a slope looks like ground beyond it; from near it does not."""
    core = Perception(EXACT)
    far, near = Pose(85, 100, 0), Pose(93, 100, 0)
    for index in range(60):
        core.process(CameraFrame(1 + index, far, draw(far, hall)))
    assert navigable_cells(core.world_map().cells)[99:101, 95].all()
    blocked = draw(near, lambda x, y: hall(x, y) & (x < 95))
    for index in range(3):
        core.process(CameraFrame(100 + index, near, blocked))
    assert not navigable_cells(core.world_map().cells)[99:101, 95].any()


@given(st.permutations(range(12)))
@settings(max_examples=10, deadline=None)
def test_the_order_of_frames_does_not_matter(order):
    sequence = frames(drive(count=12), corridor)
    shuffled = [
        CameraFrame(1 + i, sequence[k].pose, sequence[k].image) for i, k in enumerate(order)
    ]
    assert (mapped(sequence) == mapped(shuffled)).all()


def test_a_mirrored_world_gives_the_mirrored_map():
    poses = drive(count=20)
    mirrored = [Pose(p.x, 200 - p.y, -p.yaw, p.pitch, -p.roll) for p in poses]

    def bay(x, y):
        return corridor(x, y) | ((x > 100) & (y > 100) & (y < 110))

    cells = mapped(frames(poses, bay))
    flipped = mapped(frames(mirrored, lambda x, y: bay(x, 200 - y)))
    difference = navigable_cells(cells) != navigable_cells(flipped[::-1])
    assert difference.sum() <= 0.02 * navigable_cells(cells).sum()


def test_what_lies_behind_an_obstacle_is_unknown():
    def wall_across(x, y):
        return corridor(x, y) & ~((x > 96) & (x < 97))

    cells = mapped(frames([Pose(90, 100, 0)] * 10, wall_across))
    assert (cells[98:102, 92:94] >= 0).all()
    assert (cells[98:102, 99:] == -1).all()


def test_the_base_of_a_wall_observed_from_afar_is_an_edge():
    """A row of pixels is half a cell long there, too coarse to place a cell before or behind it."""

    def at_the_end(x: float) -> np.ndarray:
        core = Perception(EXACT)
        for frame in frames([Pose(x, 100, 0)] * 10, hall):
            core.process(frame)
        return core.navigation_map().cells[396:404, 396:404]  # [m] 99 to 101

    far = at_the_end(94.0)
    assert (far <= EDGE).all()
    assert (far == EDGE).any(axis=1).all()
    near = at_the_end(97.0)
    assert (near[:, 5] > EDGE).all()
    assert (near[:, :3] < EDGE).all()


def test_new_evidence_can_revoke_free_cells():
    core = Perception(EXACT)
    for index in range(5):
        core.process(CameraFrame(1 + index, Pose(90, 100, 0), draw(Pose(90, 100, 0), corridor)))
    before = navigable_cells(core.world_map().cells)
    assert before[99:101, 93].all()

    def blocked(x, y):
        return corridor(x, y) & (x < 93)

    for index in range(20):
        pose = Pose(91, 100, 0)
        core.process(CameraFrame(10 + index, pose, draw(pose, blocked)))
    assert not navigable_cells(core.world_map().cells)[99:101, 93].any()


def test_driving_over_the_same_ground_again_and_again_does_not_degrade_the_map():
    sequence = frames(drive(), corridor)
    core = Perception(EXACT)
    for frame in sequence:
        core.process(frame)
    once = navigable_cells(core.world_map().cells)
    for _ in range(20):
        for frame in sequence:
            core.process(frame)
    often = navigable_cells(core.world_map().cells)
    assert (often | ~once).all()
    often[95:105] = False
    assert not often.any()


def test_nothing_is_written_outside_of_the_world():
    pose = Pose(199.0, 199.0, math.radians(45))
    image = draw(pose, lambda x, y: np.ones_like(x, bool))
    cells = mapped([CameraFrame(1, pose, image)] * 3)
    assert not (cells[:190, :190] >= 0).any()


@pytest.mark.parametrize("color", [(0, 0, 0), WALL, SKY])
def test_an_image_without_ground_maps_no_free_cell(color):
    image = np.full((160, 320, 3), color, np.uint8)
    cells = mapped([CameraFrame(1, Pose(90, 100, 0), image)] * 5)
    assert not navigable_cells(cells).any()


def test_an_image_from_inside_a_wall_maps_nothing():
    """Back faces are not drawn: sky shows below the horizon, as bright as sand in shadow."""
    image = np.full((160, 320, 3), BRIGHT_SKY, np.uint8)
    core = Perception(EXACT)
    for index in range(5):
        result = core.process(CameraFrame(1 + index, Pose(90, 100, 0), image))
    assert (core.world_map().cells == -1).all()
    assert len(result.nav.ranges) == 0
    assert (result.scan.ranges[np.isfinite(result.scan.ranges)] < 1.0).all()


def test_ground_up_to_the_horizon_is_mapped_near_the_rover_only():
    """It is a slope, or a fault of the image."""
    image = np.full((160, 320, 3), 255, np.uint8)
    cells = mapped([CameraFrame(1, Pose(90, 100, 0), image)] * 5)
    _, cols = np.nonzero(navigable_cells(cells))
    assert cols.max() <= 95


def test_the_image_of_a_live_simulator_belongs_to_the_pose_before():
    poses = drive(count=30)
    exact = mapped(frames(poses, corridor))
    lagging = [
        CameraFrame(1 + i, pose, draw(poses[max(0, i - 1)], corridor))
        for i, pose in enumerate(poses)
    ]

    def wrong(lag: int) -> int:
        cells = mapped(lagging, PerceptionConfig(image_lag=lag))
        return int((navigable_cells(exact) != navigable_cells(cells)).sum())

    assert wrong(1) < wrong(0) / 2
