"""Images of which only the lower rows are rendered: these rows are as in whole images."""

from __future__ import annotations

import math
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from rover_bridge.codec import decode_telemetry
from rover_common.geometry import Pose
from rover_perception.recipes import first_row_read
from rover_simulator.sensors.jpeg import encode_jpeg, first_row_to_encode
from rover_simulator.sensors.renderer import Renderer
from rover_simulator.simulation import Simulation
from rover_simulator.world.generator import generate_world
from rover_simulator.world.terrain import terrain_of
from rover_simulator.world.world import World
from rover_tools.evaluation.closed_loop import Loop

SEED = 7
FRAMES = 50  # of 0.08 s: it turns, and drives off
# Level; nose down and up; to either side; both, far beyond what driving on flat ground does.
TILTS_DEG = [(0, 0), (3, 0), (-3, 0), (0, 4), (0, -4), (12, -15), (-20, 10)]


@pytest.fixture(scope="module")
def world() -> World:
    return generate_world(SEED, 0.5)


@pytest.fixture(scope="module")
def renderer(world: World) -> Renderer:
    return Renderer(world, terrain_of(world, SEED))


def tilted(start: Pose, pitch_deg: float, roll_deg: float) -> Pose:
    return Pose(start.x, start.y, start.yaw, math.radians(pitch_deg), math.radians(roll_deg))


def decoded(image: NDArray[np.uint8]) -> NDArray[Any]:
    return np.asarray(cv2.imdecode(np.frombuffer(encode_jpeg(image), np.uint8), cv2.IMREAD_COLOR))


@pytest.mark.parametrize(("pitch_deg", "roll_deg"), TILTS_DEG)
def test_rows_below_the_crop_decode_as_in_the_whole_image(renderer, world, pitch_deg, roll_deg):
    pose = tilted(world.start, pitch_deg, roll_deg)
    whole = renderer.render(pose).image
    for row in {first_row_read(pose), 16, 17, 65, 80, 152}:
        first_row = first_row_to_encode(row)
        cropped = renderer.render(pose, first_row=first_row).image
        assert not cropped[:first_row].any()
        assert np.array_equal(cropped[first_row:], whole[first_row:])
        assert np.array_equal(decoded(cropped)[row:], decoded(whole)[row:])


def test_at_most_one_jpeg_block_is_rendered_above_the_rows_read():
    level = Pose(100.0, 100.0, 0.0)
    assert first_row_to_encode(first_row_read(level)) == 64


@pytest.mark.parametrize("pitch_deg", [-80, 80, 180])
def test_the_first_row_read_is_valid_at_extreme_pitch(pitch_deg):
    assert 0 <= first_row_read(Pose(100.0, 100.0, 0.0, pitch=math.radians(pitch_deg))) <= 152


def test_decisions_are_the_same_with_whole_images(world):
    cropped, whole = (Loop(Simulation(world, SEED, 4)) for _ in range(2))
    whole.simulation.crop_images(lambda _: 0)
    try:
        for _ in range(FRAMES):
            first, second = cropped.decide(), whole.decide()
            assert first == second
            for loop in (cropped, whole):
                loop.answer(first)
                loop.simulation.advance()
    finally:
        cropped.close()
        whole.close()
    assert cropped.simulation.distance > 0.5
    maps = [loop.perception.navigation_map().cells for loop in (cropped, whole)]
    assert np.array_equal(*maps)
    assert (maps[0] >= 0).sum() > 100
    images = [decode_telemetry(loop.simulation.telemetry()).image for loop in (cropped, whole)]
    assert not np.array_equal(*images)
