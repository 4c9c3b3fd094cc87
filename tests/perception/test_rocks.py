"""Rocks: one entry each, at the right place, and none where there is none."""

import cv2
import numpy as np
import pytest

from rover_common.dataflow import CameraFrame
from rover_common.geometry import Pose
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception
from rover_simulator.renderer import Renderer, encode_jpeg
from rover_simulator.terrain import Terrain
from rover_simulator.world import World


def hall(samples: list[tuple[float, float]]) -> World:
    """An open hall with samples in it."""
    navigable = np.zeros((200, 200), bool)
    navigable[85:116, 80:121] = True
    return World("hall", navigable, np.array(samples, float).reshape(-1, 2), Pose(85, 100, 0))


def rocks_seen(world: World, poses: list[Pose]) -> list[tuple[float, float]]:
    renderer = Renderer(world, Terrain.of(world.navigable))
    core = Perception(PerceptionConfig(image_lag=0))
    percept = None
    for index, pose in enumerate(poses):
        jpeg = encode_jpeg(renderer.render(pose).image)
        image = cv2.cvtColor(cv2.imdecode(np.frombuffer(jpeg, np.uint8), 1), cv2.COLOR_BGR2RGB)
        percept = core.process(CameraFrame(1 + index * 40_000_000, pose, image))
    assert percept is not None
    return [(rock.x, rock.y) for rock in percept.rocks]


def approach(x: float, y: float, tilt: float = 0.0) -> list[Pose]:
    """From 6 m to 1.5 m before a point, along x."""
    return [
        Pose(x - distance, y, 0.0, tilt * np.sin(distance), tilt * np.cos(distance))
        for distance in np.arange(6.0, 1.5, -0.25)
    ]


@pytest.mark.parametrize("tilt", [0.0, 0.02])
def test_one_rock_is_one_entry_near_its_place(tilt):
    (found,) = rocks_seen(hall([(100.0, 100.4)]), approach(100.0, 100.0, tilt))
    assert np.hypot(found[0] - 100.0, found[1] - 100.4) < 0.35


def test_from_two_sides_it_stays_one():
    away = [Pose(106 - 0.25 * i, 100.2, np.pi) for i in range(16)]
    found = rocks_seen(hall([(100.0, 100.0)]), approach(100.0, 100.2) + away)
    assert len(found) == 1


def test_two_rocks_side_by_side_are_two():
    found = rocks_seen(hall([(100.0, 99.2), (100.0, 101.2)]), approach(100.0, 100.2))
    assert len(found) == 2
    assert sorted(round(y) for _, y in found) == [99, 101]


def test_no_rock_where_there_is_none():
    turning = [Pose(90, 100, 0.2 * i) for i in range(32)]
    assert rocks_seen(hall([]), approach(115.0, 100.0) + turning) == []


def test_recorded_samples_are_located(recordings):
    from rover_bringup.results import load_samples
    from rover_simulator.recording import read_recording

    core = Perception(PerceptionConfig(image_lag=0))
    percept = None
    for index, frame in enumerate(read_recording(recordings / "udacity/test_dataset").frames):
        image = cv2.cvtColor(cv2.imread(str(frame.image_path)), cv2.COLOR_BGR2RGB)
        percept = core.process(CameraFrame(1 + index * 40_000_000, frame.pose, image))
    assert percept is not None
    ((x, y),) = load_samples(recordings / "udacity/samples.csv")
    (rock,) = percept.rocks
    assert np.hypot(rock.x - x, rock.y - y) < 0.5
    assert rock.observations > 10
