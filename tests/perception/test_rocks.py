"""Rocks: one confirmed track each, at the right position, and none without a rock."""

import cv2
import numpy as np
import pytest

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.types import CameraFrame, RockTrack
from rover_perception.camera.ground_projection import GroundProjection
from rover_perception.camera.segmentation import rock_mask
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception
from rover_perception.tracking.rock_detection import RockSighting, detect_rocks
from rover_perception.tracking.rock_tracks import CONFIRMED_OBSERVATIONS, RockTracks
from rover_simulator.sensors.jpeg import encode_jpeg
from rover_simulator.sensors.renderer import Renderer
from rover_simulator.world.terrain import Terrain
from rover_simulator.world.world import World

CAMERA_HEIGHT = ORIGIN_HEIGHT + ROVER_CAMERA.up  # [m]
LEVEL = Pose(100.0, 100.0, 0.0)


HALL = np.zeros((200, 200), bool)
HALL[85:116, 80:121] = True
TERRAIN = Terrain.of(HALL)


def hall(samples: list[tuple[float, float]]) -> World:
    """An open hall with samples in it."""
    return World("hall", HALL, np.array(samples, float).reshape(-1, 2), Pose(85, 100, 0))


def rocks_found(world: World, poses: list[Pose]) -> list[tuple[float, float]]:
    renderer = Renderer(world, TERRAIN)
    core = Perception(PerceptionConfig(image_lag=0))
    result = None
    for index, pose in enumerate(poses):
        image = through_jpeg(renderer.render(pose).image)
        result = core.process(CameraFrame(1 + index * 40_000_000, pose, image))
    assert result is not None
    return [(rock.x, rock.y) for rock in result.rocks]


def through_jpeg(image: np.ndarray) -> np.ndarray:
    picture = cv2.imdecode(np.frombuffer(encode_jpeg(image), np.uint8), cv2.IMREAD_COLOR)
    return cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)


def approach(x: float, y: float, tilt: float = 0.0) -> list[Pose]:
    """From 6 m to 1.5 m before a point, along x."""
    return [
        Pose(x - distance, y, 0.0, tilt * np.sin(distance), tilt * np.cos(distance))
        for distance in np.arange(6.0, 1.5, -0.25)
    ]


@pytest.mark.parametrize("tilt", [0.0, 0.02])
def test_one_rock_is_one_track_near_its_position(tilt):
    (found,) = rocks_found(hall([(100.0, 100.4)]), approach(100.0, 100.0, tilt))
    assert np.hypot(found[0] - 100.0, found[1] - 100.4) < 0.35


def test_a_rock_observed_from_two_sides_is_one_track():
    away = [Pose(106 - 0.25 * i, 100.2, np.pi) for i in range(16)]
    found = rocks_found(hall([(100.0, 100.0)]), approach(100.0, 100.2) + away)
    assert len(found) == 1


def test_two_rocks_side_by_side_are_two_tracks():
    found = rocks_found(hall([(100.0, 99.2), (100.0, 101.2)]), approach(100.0, 100.2))
    assert len(found) == 2
    assert sorted(round(y) for _, y in found) == [99, 101]


def test_no_rock_is_reported_without_one():
    turning = [Pose(90, 100, 0.2 * i) for i in range(32)]
    assert rocks_found(hall([]), approach(115.0, 100.0) + turning) == []


def sighting(origin: tuple[float, float], target: tuple[float, float, float]) -> RockSighting:
    """A line of sight from the camera's height over a point [m] through another one."""
    camera = np.array([*origin, CAMERA_HEIGHT])
    line = np.array(target) - camera
    distance = float(np.linalg.norm(line))
    return RockSighting(camera, line / distance, 0.05 + 0.006 * distance)


def tracked(sightings: list[RockSighting]) -> tuple[RockTrack, ...]:
    tracks = RockTracks()
    for index, one in enumerate(sightings):
        tracks.add((one,), index)
    return tracks.confirmed()


def test_no_track_is_confirmed_where_lines_to_two_rocks_cross():
    # both are too far away to have a range; lines cross 2 m from the first rock, 12 from the second
    first = [sighting((84.0 + 0.1 * i, 41.2), (94.0, 42.2, 0.065)) for i in range(3)]
    second = [sighting((104.4, 27.1 + 0.1 * i), (99.0, 37.5, 0.065)) for i in range(3)]
    assert tracked(first + second) == ()


def test_a_track_is_tentative_until_enough_frames_observed_it():
    tracks = RockTracks()
    for index in range(CONFIRMED_OBSERVATIONS):
        assert tracks.confirmed() == ()
        tracks.add((sighting((97.0, 98.0 + index), (100.0, 100.2, 0.065)),), index)
        assert len(tracks.tracks) == 1
    (rock,) = tracks.confirmed()
    assert (rock.observations, rock.last_seen) == (CONFIRMED_OBSERVATIONS, index)


def test_a_rock_observed_past_another_one_keeps_its_own_track():
    near = [sighting((95.0 + 0.2 * i, 100.0), (100.0, 100.2, 0.065)) for i in range(22)]
    far = [sighting((98.0, 95.0 + 0.2 * i), (100.0, 106.0, 0.065)) for i in range(30)]
    found = tracked(near + far)
    assert len(found) == 2
    assert np.hypot(found[0].x - 100.0, found[0].y - 100.2) < 0.1
    assert np.hypot(found[1].x - 100.0, found[1].y - 106.0) < 0.3


def test_lines_that_do_not_meet_are_not_confirmed():
    # yellow that stays 1.5 m ahead of the camera, as an artefact at a wall's edge does
    ahead = [
        sighting((95.0 + 0.15 * i, 100.0), (96.5 + 0.15 * i, 100.0 + 0.4 * (-1) ** i, 0.065))
        for i in range(8)
    ]
    assert tracked(ahead) == ()


def test_dark_ground_tinted_by_a_sample_is_no_second_sample():
    projection = GroundProjection.of(ROVER_CAMERA, LEVEL)
    tinted = 0
    for left in range(150, 166):
        image = np.full((160, 320, 3), (30, 25, 21), np.uint8)
        image[98:102, left : left + 6] = (170, 143, 15)
        image[102:] = (230, 210, 190)
        image[90:97, left - 12 : left] = (70, 60, 50)
        image = through_jpeg(image)
        mask = rock_mask(image, projection)
        tinted += cv2.connectedComponents(mask, connectivity=8)[0] > 2
        assert len(detect_rocks(image, mask, projection, LEVEL).x) == 1
    assert tinted > 3  # the JPEG file tints it


def test_two_samples_in_one_chroma_block_are_two():
    projection = GroundProjection.of(ROVER_CAMERA, LEVEL)
    image = np.full((160, 320, 3), (230, 210, 190), np.uint8)
    for left in (161, 169):
        image[98:102, left : left + 5] = (170, 143, 15)
    assert len(detect_rocks(image, rock_mask(image, projection), projection, LEVEL).x) == 2


def test_recorded_samples_are_located(recordings):
    from rover_simulator.recordings.recording import read_recording
    from rover_tools.evaluation.results import load_samples

    core = Perception(PerceptionConfig(image_lag=0))
    result = None
    for index, frame in enumerate(read_recording(recordings / "udacity/test_dataset").frames):
        image = cv2.cvtColor(cv2.imread(str(frame.image_path)), cv2.COLOR_BGR2RGB)
        result = core.process(CameraFrame(1 + index * 40_000_000, frame.pose, image))
    assert result is not None
    ((x, y),) = load_samples(recordings / "udacity/samples.csv")
    (rock,) = result.rocks
    assert np.hypot(rock.x - x, rock.y - y) < 0.5
    assert rock.observations > 10
