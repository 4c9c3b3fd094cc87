"""The relief of walls from skylines: found again where it was put in."""

from pathlib import Path

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_simulator.recordings.recording import read_recording
from rover_simulator.sensors.renderer import Renderer
from rover_simulator.world.terrain import COUNT, Terrain
from rover_simulator.world.world import World
from rover_tools.benchmarks.pictures import (
    EVERY,
    Shot,
    draw_pairs,
    ground_mask,
    level_frames,
    sky_mask,
)
from rover_tools.benchmarks.simulator import motion_errors
from rover_tools.benchmarks.skyline_relief import Skyline, carve, read_skyline

ROOM = np.zeros((200, 200), bool)
ROOM[85:116, 85:116] = True
WORLD = World("room", ROOM, np.empty((0, 2)), Pose(100, 100, 0))


def shots(terrain: Terrain, poses: list[Pose]) -> list[Shot]:
    renderer = Renderer(WORLD, terrain)
    images = [renderer.render(pose).image for pose in poses]
    return [Shot(p, i, sky_mask(i, p)) for p, i in zip(poses, images, strict=True)]


def agreement(a: list[Shot], b: list[Shot]) -> float:
    one, other = (np.stack([shot.sky for shot in side]) for side in (a, b))
    return float((one & other).sum() / (one | other).sum())


def views(count: int, seed: int) -> list[Pose]:
    random = np.random.default_rng(seed)
    rows = random.uniform((92, 92, -3), (109, 109, 3), (count, 3))
    return [Pose(float(x), float(y), float(yaw)) for x, y, yaw in rows]


def test_skylines_tell_the_relief_that_other_views_see():
    hidden, median = Terrain.of(ROOM, 5), Terrain.of(ROOM, relief=np.ones((COUNT, COUNT)))
    asked = views(10, 2)
    seen, truth = shots(hidden, views(60, 1)), shots(hidden, asked)
    relief = carve(median, read_skyline((shot.pose, shot.sky) for shot in seen))
    without = agreement(truth, shots(median, asked))
    carved = agreement(truth, shots(Terrain.of(ROOM, relief=relief), asked))
    assert carved > 0.95 > without


def test_no_skyline_no_relief():
    nothing = Skyline(
        np.zeros((1, 3), np.float32), np.array([[1, 0, 0]], np.float32), np.zeros(1, bool)
    )
    relief = carve(Terrain.of(ROOM, relief=np.ones((COUNT, COUNT))), nothing)
    assert relief == pytest.approx(1.0)


def test_sky_is_neither_sand_nor_wall_nor_noise():
    pose = Pose(0, 0, 0)
    picture = np.full((160, 320, 3), (36, 25, 21), np.uint8)
    picture[80:] = (238, 220, 205)
    picture[:40, 100:200] = (126, 117, 113)
    noisy = np.random.default_rng(0).integers(60, 180, (30, 60, 1))
    picture[:30, 220:280] = noisy
    sky = sky_mask(picture, pose)
    assert sky[:39, 101:199].all()
    assert sky.sum() <= 40 * 100
    assert ground_mask(picture)[81:].all()
    assert not (ground_mask(picture) & sky).any()


def test_the_picture_is_small(tmp_path: Path):
    image = np.zeros((160, 320, 3), np.uint8)
    draw_pairs(tmp_path / "pairs.png", [(image, image)])
    assert (tmp_path / "pairs.png").stat().st_size < 10_000


def test_vehicle_follows_recorded_commands(recordings: Path):
    """The bounds that the simulator is meant to keep, medians over five seconds."""
    errors = motion_errors(recordings)
    assert errors["speed_error"] <= 0.05
    assert errors["yaw_error_deg"] <= 2.0
    assert errors["position_error"] <= 0.25


def test_recorded_sky_has_the_share_that_was_measured(recordings: Path):
    from rover_tools.benchmarks.pictures import _shot

    frames = read_recording(recordings / "udacity" / "test_dataset").frames
    sky = [_shot(frame).sky for frame in level_frames(frames, EVERY)]
    assert np.mean(sky) == pytest.approx(0.06, abs=0.015)
    assert not np.array(sky)[:, 90:].any()
