"""Worlds: generated from a seed, read from folders and maps, and refused."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from scipy import ndimage

from rover_common.geometry import Pose
from rover_common.ground_truth import TruthError
from rover_simulator.world.generator import generate_world, world_of_map
from rover_simulator.world.world import World, WorldError

HALL = np.zeros((200, 200), bool)
HALL[80:121, 80:121] = True


@pytest.mark.parametrize("seed", range(8))
def test_generated_worlds_are_connected_and_of_the_originals_size(seed):
    world = generate_world(seed)
    _, regions = ndimage.label(world.navigable)
    assert regions == 1
    assert 1000 < world.navigable.sum() < 3000
    assert len(world.samples) == 6
    assert world.navigable[int(world.start.y), int(world.start.x)]
    reachable = ndimage.binary_dilation(world.navigable, iterations=2)
    assert all(reachable[int(y), int(x)] for x, y in world.samples)
    assert not world.navigable[[0, -1]].any()


def test_a_world_is_read_as_it_was_written(tmp_path):
    world = generate_world(5)
    world.save(tmp_path)
    again = World.load(tmp_path)
    assert (again.navigable == world.navigable).all()
    assert np.allclose(again.samples, world.samples)
    assert again.start == world.start


def test_a_bad_world_is_one_clear_error(tmp_path):
    with pytest.raises(TruthError, match=r"map\.png"):
        World.load(tmp_path)
    generate_world(5).save(tmp_path)
    (tmp_path / "world.yaml").write_text("start: nowhere")
    with pytest.raises(WorldError, match=r"world\.yaml"):
        World.load(tmp_path)


def test_large_holes_are_walls_and_small_ones_are_rocks():
    ground = HALL.copy()
    ground[90:94, 90:94] = False
    ground[110, 110:112] = False
    world = World("holes", ground, np.empty((0, 2)), Pose(100, 100, 0))
    assert [(b.x, b.y) for b in world.boulders] == [(110.5, 110.5), (111.5, 110.5)]


@pytest.mark.parametrize("content", [b"", b"not an image"])
def test_a_map_that_is_no_image_is_refused(tmp_path, content):
    (tmp_path / "map.png").write_bytes(content)
    with pytest.raises(TruthError, match="not an image"):
        world_of_map(tmp_path / "map.png", 1)


@pytest.mark.parametrize(
    ("pixels", "why"),
    [(np.zeros((200, 200)), "no navigable cell"), (np.ones((100, 200)), "expected 200 x 200")],
)
def test_a_map_without_ground_or_of_another_size_is_refused(tmp_path, pixels, why):
    cv2.imwrite(str(tmp_path / "map.png"), pixels.astype(np.uint8) * 255)
    with pytest.raises(TruthError, match=why):
        world_of_map(tmp_path / "map.png", 1)


def test_a_maps_samples_come_from_the_seed(tmp_path):
    world = generate_world(11)
    world.save(tmp_path)
    first, again, other = (world_of_map(tmp_path / "map.png", seed) for seed in (1, 1, 2))
    assert np.array_equal(first.samples, again.samples)
    assert not np.array_equal(first.samples, other.samples)
    assert first.navigable[int(first.start.y), int(first.start.x)]
    assert len(first.samples) == 6
