"""The insets that a server sends, and the screen that shows them."""

from __future__ import annotations

import base64
from pathlib import Path

import cv2
import numpy as np
import pytest
from simulator_controls import GOOD, simulation_of

from rover_simulator.sensors.jpeg import encode_jpeg
from rover_simulator.sensors.screen import SavedScreen, screen_picture
from rover_simulator.simulation import Simulation

RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)


def picture(height: int, width: int, color: tuple[int, int, int]) -> np.ndarray:
    return np.full((height, width, 3), color, np.uint8)


CAMERA, MAP, BIRDSEYE = picture(160, 320, RED), picture(400, 400, GREEN), picture(160, 320, BLUE)


def base64_of(image: np.ndarray) -> str:
    return base64.b64encode(encode_jpeg(image)).decode()


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    return simulation_of()


@pytest.fixture
def folder(simulation, tmp_path) -> Path:
    simulation.show_insets(SavedScreen(tmp_path / "new" / "insets").show)
    return tmp_path / "new" / "insets"


def saved(folder: Path) -> list[str]:
    return sorted(path.name.partition("_")[2] for path in folder.iterdir())


def test_the_insets_have_their_places_on_the_screen():
    screen = screen_picture(CAMERA, {"inset_image1": MAP, "inset_image2": BIRDSEYE})
    assert screen.shape == (768, 1024, 3)
    colors = {(x, y): tuple(screen[768 - y, x].tolist()) for x, y in (
        (512, 700), (1013, 11), (750, 275), (12, 14), (260, 130), (12, 140), (260, 262), (500, 100),
    )}  # fmt: skip
    assert colors == {
        (512, 700): RED,  # in place of the view from behind
        (1013, 11): GREEN, (750, 275): GREEN,  # the first inset, below on the right
        (12, 14): RED, (260, 130): RED,  # the camera, below on the left
        (12, 140): BLUE, (260, 262): BLUE,  # the second inset above it
        (500, 100): (0, 0, 0),
    }  # fmt: skip


def test_insets_are_saved_as_they_came_and_on_the_screen(simulation, folder):
    insets = {"inset_image1": base64_of(MAP), "inset_image2": base64_of(BIRDSEYE)}
    assert simulation.handle("data", GOOD | insets)
    assert saved(folder) == ["inset_image1.jpg", "inset_image2.jpg", "screen.jpg"]
    (first,) = folder.glob("*_inset_image1.jpg")
    assert first.read_bytes() == base64.b64decode(insets["inset_image1"])
    assert first.name.startswith(f"{simulation.time:08.2f}")
    (screen,) = folder.glob("*_screen.jpg")
    shown = cv2.imread(str(screen))
    assert np.abs(shown[768 - 100, 900].astype(int) - GREEN[::-1]).max() < 8


@pytest.mark.parametrize("text", ["", base64.b64encode(b"no picture").decode()])
def test_what_is_no_picture_changes_nothing(simulation, folder, text):
    assert simulation.handle("data", GOOD | {"inset_image1": base64_of(MAP)})
    before = saved(folder)
    assert simulation.handle("data", GOOD | {"inset_image1": text})
    assert saved(folder) == before
    simulation.advance()
    assert simulation.handle("data", GOOD | {"inset_image2": base64_of(BIRDSEYE)})
    latest = max(folder.glob("*_screen.jpg"))
    shown = cv2.imread(str(latest))
    assert np.abs(shown[768 - 100, 900].astype(int) - GREEN[::-1]).max() < 8  # still there


def test_only_a_simulator_that_shows_insets_says_so(simulation, folder):
    assert simulation.telemetry()["shows_insets"] == "1"
    assert "shows_insets" not in simulation_of().telemetry()
