"""The pictures that answers carry, on made inputs."""

from __future__ import annotations

import base64

import cv2
import numpy as np
import pytest

from rover_bridge.codec import encode_drive, shows_insets
from rover_bridge.insets import ROCK, ROVER, TRACK, Insets, MapScene, encode_inset, map_inset
from rover_common.geometry import Pose
from rover_common.types import Command, GridMap

FAR = Pose(180.0, 20.0, 0.0)  # where it covers no cell of interest
UNKNOWN, FREE, EDGE, OBSTACLE = -1, 0, 50, 100
DARK, BLUE, RED = (25, 25, 25), (60, 105, 225), (150, 45, 45)
GREEN, ORANGE, PINK = (30, 95, 40), (240, 140, 30), (200, 60, 200)


def grid_with(value: int, resolution: float = 1.0) -> GridMap:
    """A map of unknown cells, but for one of 1 m at x = 60, y = 150."""
    count = round(200 / resolution)
    cells = np.full((count, count), UNKNOWN, np.int8)
    cell = slice(round(150 / resolution), round(151 / resolution))
    cells[cell, round(60 / resolution) : round(61 / resolution)] = value
    return GridMap(resolution, 0.0, 0.0, cells)


def truth_with(navigable: bool) -> np.ndarray:
    truth = np.zeros((200, 200), bool)
    truth[150, 60] = navigable
    truth[10, 10] = True  # a truth without a navigable cell is none
    return truth


def at(picture: np.ndarray, x: float, y: float) -> tuple[int, ...]:
    """The colour at a point [m]: two pixels to the metre, north above."""
    return tuple(int(level) for level in picture[399 - int(y * 2), int(x * 2)])


@pytest.mark.parametrize(
    ("value", "navigable", "color"),
    [
        (UNKNOWN, None, DARK), (FREE, None, BLUE), (OBSTACLE, None, RED), (EDGE, None, RED),
        (UNKNOWN, False, DARK), (FREE, False, ORANGE), (OBSTACLE, False, RED),
        (UNKNOWN, True, GREEN), (FREE, True, BLUE), (OBSTACLE, True, PINK),
    ],
)  # fmt: skip
@pytest.mark.parametrize("resolution", [0.25, 1.0])
def test_a_cell_has_the_colour_of_what_map_and_truth_say(value, navigable, color, resolution):
    truth = None if navigable is None else truth_with(navigable)
    picture = map_inset(MapScene(FAR, grid_with(value, resolution), truth))
    assert picture.shape == (400, 400, 3)
    for x, y in ((60.1, 150.1), (60.9, 150.9)):
        assert at(picture, x, y) == color
    for x, y in ((59.9, 150.5), (61.1, 150.5), (60.5, 149.9), (60.5, 151.1)):
        assert at(picture, x, y) == DARK


def test_without_a_map_only_the_truth_is_shown():
    assert at(map_inset(MapScene(FAR, truth=truth_with(True))), 60.5, 150.5) == GREEN
    assert at(map_inset(MapScene(FAR)), 60.5, 150.5) == DARK


def test_rover_track_and_rocks_are_drawn_at_their_places():
    track = np.array([(20.0, 30.0), (40.0, 30.0), (40.0, 60.0)])
    rocks = np.array([(100.0, 100.0)])
    picture = map_inset(MapScene(Pose(40.0, 60.0, 0.0), track=track, rocks=rocks))
    assert at(picture, 40.2, 60.2) == ROVER
    assert at(picture, 45.2, 60.2) == ROVER  # it is headed east
    assert at(picture, 35.0, 60.2) == DARK
    assert at(picture, 30.2, 30.2) == TRACK
    assert at(picture, 40.2, 45.2) == TRACK
    assert at(picture, 100.2, 100.2) == ROCK


def test_an_inset_is_a_jpeg_file_in_base64():
    picture = map_inset(MapScene(FAR, grid_with(FREE), truth_with(True)))
    data = np.frombuffer(base64.b64decode(encode_inset(picture), validate=True), np.uint8)
    decoded = cv2.cvtColor(cv2.imdecode(data, cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
    assert np.abs(decoded.astype(int) - picture).mean() < 2.0


def test_a_command_carries_the_insets():
    drive = encode_drive(Command(), insets=Insets("bWFw", "YmlyZA=="))
    assert (drive["inset_image1"], drive["inset_image2"]) == ("bWFw", "YmlyZA==")


@pytest.mark.parametrize(
    ("wire", "shown"),
    [
        ({}, True),  # the original
        ({"sim_time": "1.0"}, False),  # not the original, and it says nothing
        ({"sim_time": "1.0", "shows_insets": "1"}, True),
        ({"shows_insets": "0"}, False),
        ({"shows_insets": 1}, True),
        ({"shows_insets": "yes"}, False),
        ([], False),
    ],
)
def test_which_client_shows_insets(wire, shown):
    assert shows_insets(wire) is shown
