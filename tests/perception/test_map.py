"""The map that frames add up to."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scene import BRIGHT_SKY, SHADOWED_SAND, SKY, WALL, draw

from rover_common.geometry import Pose
from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import CameraFrame
from rover_perception.config import PerceptionConfig
from rover_perception.frame_validation import FrameError
from rover_perception.perception import Perception

LIVE = PerceptionConfig(image_lag=0)
CORRIDOR = (95.0, 105.0)


def corridor(x, y):
    """Floor between two walls along x."""
    return (y > CORRIDOR[0]) & (y < CORRIDOR[1])


def hall(x, y):
    """The same with an end."""
    return corridor(x, y) & (x < 100)


def frames(poses: list[Pose], is_floor) -> list[CameraFrame]:
    return [
        CameraFrame(1 + index * 40_000_000, pose, draw(pose, is_floor))
        for index, pose in enumerate(poses)
    ]


def mapped(frames: list[CameraFrame], config: PerceptionConfig = LIVE) -> np.ndarray:
    core = Perception(config)
    for frame in frames:
        core.process(frame)
    return core.world_map().cells


def drive(pitch: float = 0.0, roll: float = 0.0, count: int = 40) -> list[Pose]:
    turn = math.radians(35)
    return [Pose(90 + 0.5 * i, 100.0, turn * math.sin(0.4 * i), pitch, roll) for i in range(count)]


@given(pitch=st.floats(-0.02, 0.02), roll=st.floats(-0.02, 0.02))
@settings(max_examples=10, deadline=None)
def test_a_corridor_is_rebuilt_at_any_tilt_of_driving(pitch, roll):
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
def test_a_checkerboard_of_pits_is_rebuilt_at_any_tilt(pitch, roll):
    """Up to 3.4 degrees: more than braking, throttle and turns tilt the rover by."""

    def board(x, y):
        return ((np.floor(x / 4) + np.floor(y / 4)) % 2 == 0) | (np.abs(y - 100) < 2)

    navigable = navigable_cells(mapped(frames(drive(pitch, roll), board)))
    left, bottom, right, top = 90, 94, 110, 106  # farther off, a pit is one or two rows of pixels
    rows, cols = np.nonzero(navigable[bottom:top, left:right])
    assert len(rows) > 80
    assert board(cols + left + 0.5, rows + bottom + 0.5).mean() > 0.97
    assert navigable[99:101, 94:105].mean() > 0.95


def test_sand_in_shadow_is_ground_and_its_edge_is_none():
    def shadowed(x, y):
        return (x > 93) & (y > 98)

    def image(pose):
        picture = draw(pose, hall)
        shadow = draw(pose, lambda x, y: hall(x, y) & shadowed(x, y), SHADOWED_SAND)
        in_shadow = (shadow == SHADOWED_SAND).all(axis=2)
        picture[in_shadow] = SHADOWED_SAND
        return picture

    core = Perception(LIVE)
    for index, pose in enumerate(drive(count=12)):
        core.process(CameraFrame(1 + index * 40_000_000, pose, image(pose)))
    assert navigable_cells(core.world_map().cells)[97:103, 94:98].all()


def test_near_looks_outvote_any_number_of_far_ones():
    """From afar the sand of a slope looks like ground beyond it; near by it does not."""
    core = Perception(LIVE)
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
    seen = frames(drive(count=12), corridor)
    shuffled = [CameraFrame(1 + i, seen[k].pose, seen[k].image) for i, k in enumerate(order)]
    assert (mapped(seen) == mapped(shuffled)).all()


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


def test_a_few_looks_at_a_wall_from_afar_leave_its_foot_to_be_explored():
    """A row of pixels is half a cell long there: they cannot tell on which side of it a cell is."""

    def at_the_end(x: float) -> np.ndarray:
        core = Perception(LIVE)
        for frame in frames([Pose(x, 100, 0)] * 10, hall):
            core.process(frame)
        return core.navigation_map().cells[396:404, 396:404]  # [m] 99 to 101

    far = at_the_end(94.0)
    assert (far <= EDGE).all()
    assert (far == EDGE).any(axis=1).all()
    near = at_the_end(97.0)
    assert (near[:, 5] > EDGE).all()
    assert (near[:, :3] < EDGE).all()


def test_evidence_can_be_taken_back():
    core = Perception(LIVE)
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


def test_ten_minutes_over_the_same_ground_spoil_nothing():
    seen = frames(drive(), corridor)
    core = Perception(LIVE)
    for frame in seen:
        core.process(frame)
    once = navigable_cells(core.world_map().cells)
    for _ in range(7500 // len(seen)):  # at 12.5 frames a second
        for frame in seen:
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
def test_a_picture_without_ground_maps_nothing_free(color):
    image = np.full((160, 320, 3), color, np.uint8)
    cells = mapped([CameraFrame(1, Pose(90, 100, 0), image)] * 5)
    assert not navigable_cells(cells).any()


def test_from_inside_of_a_wall_nothing_is_known():
    """Its inner side shows nothing: there is sky below the horizon, as bright as sand in shadow."""
    image = np.full((160, 320, 3), BRIGHT_SKY, np.uint8)
    core = Perception(LIVE)
    for index in range(5):
        percept = core.process(CameraFrame(1 + index, Pose(90, 100, 0), image))
    assert (core.world_map().cells == -1).all()
    assert len(percept.nav.ranges) == 0
    assert (percept.scan.ranges[np.isfinite(percept.scan.ranges)] < 1.0).all()


def test_a_white_picture_is_trusted_near_the_rover_only():
    """Ground up to above the horizon is a slope, or a fault."""
    image = np.full((160, 320, 3), 255, np.uint8)
    cells = mapped([CameraFrame(1, Pose(90, 100, 0), image)] * 5)
    _, cols = np.nonzero(navigable_cells(cells))
    assert cols.max() <= 95


@pytest.mark.parametrize(
    ("pose", "shape"),
    [
        (Pose(math.nan, 0, 0), (160, 320, 3)),
        (Pose(0, 0, math.inf), (160, 320, 3)),
        (Pose(-50.0, 300.0, 0), (160, 320, 3)),
        (Pose(1e30, 100.0, 0), (160, 320, 3)),
        (Pose(90, 100, 0), (100, 320, 3)),
        (Pose(90, 100, 0), (160, 320)),
    ],
)
def test_a_bad_frame_is_refused_and_the_map_stays(pose, shape):
    core = Perception(LIVE)
    for frame in frames(drive(count=5), corridor):
        core.process(frame)
    before = core.world_map().cells
    with pytest.raises(FrameError):
        core.process(CameraFrame(999_000_000, pose, np.zeros(shape, np.uint8)))
    assert (core.world_map().cells == before).all()
    core.process(frames(drive(count=6), corridor)[-1])
    assert navigable_cells(core.world_map().cells)[navigable_cells(before)].all()
    assert core.restarts == 0


def test_time_that_falls_back_starts_a_new_map():
    core = Perception(LIVE)
    late = CameraFrame(100_000_000_000, Pose(90, 100, 0), draw(Pose(90, 100, 0), corridor))
    for _ in range(3):
        core.process(late)
    assert (core.world_map().cells >= 0).any()
    core.process(CameraFrame(1, Pose(20, 20, 0), np.zeros((160, 320, 3), np.uint8)))
    assert not navigable_cells(core.world_map().cells)[90:110].any()
    assert core.restarts == 1


def test_time_that_falls_back_a_little_keeps_the_map():
    core = Perception(LIVE)
    for index, frame in enumerate(frames(drive(count=10), corridor)):
        core.process(CameraFrame(9_000_000_000 - 40_000_000 * index, frame.pose, frame.image))
    assert (core.world_map().cells == mapped(frames(drive(count=10), corridor))).all()
    assert core.restarts == 0


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


def test_the_scan_tells_the_distance_to_a_wall():
    pose = Pose(90, 100, 0)
    core = Perception(LIVE)
    percept = core.process(CameraFrame(1, pose, draw(pose, lambda x, y: x < 94)))
    scan = percept.scan
    middle = round(-scan.angle_min / scan.angle_increment)
    assert scan.ranges[middle] == pytest.approx(4.0, abs=0.3)
    assert len(percept.nav.ranges) == len(percept.nav.bearings) > 50
    assert (percept.nav.ranges <= LIVE.max_range + 0.5).all()


def test_the_scan_keeps_to_the_conventions_of_a_laser_scan():
    """Counter-clockwise from angle_min at even steps; inf where nothing is in range."""
    pose = Pose(90, 100, 0)
    image = draw(pose, lambda x, y: (y < 102) & (x < 106))  # walls at the left and far ahead
    config = PerceptionConfig(image_lag=0, max_range=8.0)
    scan = Perception(config).process(CameraFrame(1, pose, image)).scan
    bearing = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
    assert scan.angle_increment > 0
    assert bearing[-1] == pytest.approx(-scan.angle_min)
    left = (bearing > math.radians(20)) & (bearing < math.radians(45))
    assert np.allclose(scan.ranges[left] * np.sin(bearing[left]), 2.0, atol=0.3)
    assert np.isinf(scan.ranges[np.abs(bearing) < math.radians(3)]).all()
    finite = scan.ranges[np.isfinite(scan.ranges)]
    assert ((finite >= scan.range_min) & (finite <= scan.range_max)).all()
