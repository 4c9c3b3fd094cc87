"""The video of a mission: what its frames show, and that a browser plays it."""

from __future__ import annotations

import asyncio
from pathlib import Path

import chromium as browser_tools
import numpy as np
import pytest
from chromium import chromium
from mission_logs import ROOM, grid_of, moment_at

from rover_common.geometry import Pose
from rover_tools.report.map_layers import Window
from rover_tools.report.video.animation import images_of
from rover_tools.report.video.colours import BLUE, GROUND, OBSTACLE, PURPLE, UNKNOWN
from rover_tools.report.video.composition import HEIGHT, WIDTH, Composition
from rover_tools.report.video.mission_video import LAST_FRAMES, evenly, write_video
from rover_tools.report.video.rover_scene import RoverScene
from rover_tools.report.video.snapshot import Snapshot, Video
from rover_tools.report.video.writer import FPS

WINDOW = Window(40.0, -90.0, 80.0, 30.0)  # around ROOM
SECONDS = 80


def snapshot_at(time: float, **changes) -> Snapshot:
    """A red camera image, a green vision image, and the whole room as map."""
    red, green = np.zeros((2, 160, 320, 3), np.uint8)
    red[..., 0] = green[..., 1] = 200
    values = {"camera": red, "vision": green, "grid": grid_of(ROOM), "score": (75.0, 99.0)}
    return Snapshot(moment_at(time), 1, **values | changes)


def test_camera_vision_and_map_are_side_by_side():
    frame = Composition(RoverScene(WINDOW)).frame(snapshot_at(1.0))
    assert frame.shape == (HEIGHT, WIDTH, 3)
    assert (frame[80, 160] == (200, 0, 0)).all()
    assert (frame[80, 480] == (0, 200, 0)).all()
    assert (frame[150, 800] == GROUND).all()
    assert (frame[20, 800] == UNKNOWN).all()


def test_nothing_known_yet_is_a_frame_too():
    snapshot = Snapshot(moment_at(0.0), 0)
    assert Composition(RoverScene(WINDOW)).frame(snapshot).shape == (HEIGHT, WIDTH, 3)


def test_an_image_of_another_size_is_fitted():
    frame = Composition(RoverScene(WINDOW)).frame(
        snapshot_at(0.0, camera=np.full((480, 640, 3), 90, np.uint8))
    )
    assert (frame[5:155, 5:315] == 90).all()


def test_figures_and_state_change_with_the_mission():
    composition = Composition(RoverScene(WINDOW))
    first, second = (composition.frame(snapshot_at(time))[160:] for time in (10.0, 50.0))
    assert (first != second).any(axis=(1, 2)).sum() > 40  # rows of text and of the band
    assert (second[170, 20] != second[32, 20]).any()  # the band's past, and the state now
    assert (second[32, 20] == PURPLE).all()
    assert (second[170, 20] == BLUE).all()


def test_places_of_the_map_frame_are_where_they_belong():
    cells = np.zeros((200, 200), bool)
    cells[89, 41] = True  # the second cell from the west in the northern row of the window
    grid = grid_of(cells)
    grid.cells[60, 119] = 100  # the south-east corner of the window
    view = RoverScene(WINDOW, (800, 300))
    picture = view.map(Snapshot(moment_at(0.0, pose=Pose(80.0, 75.0, 0.0)), 0, grid=grid))
    assert (picture[0:10, 10:20] == GROUND).all()
    assert (picture[290:300, 790:800] == OBSTACLE).all()
    others = (picture == GROUND).all(axis=2).sum(), (picture == OBSTACLE).all(axis=2).sum()
    assert others == (100, 100)


def test_the_track_stays_on_the_map():
    view = RoverScene(WINDOW, (800, 300))
    for time in range(41):
        picture = view.map(snapshot_at(float(time)))
    assert (picture[150, 100:400:20] == BLUE).all()


@pytest.fixture(scope="module")
def video(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("video") / "mission.webm"
    snapshots = (snapshot_at(float(time)) for time in range(SECONDS))
    assert write_video(path, snapshots, RoverScene(WINDOW)) == Video(
        "mission.webm", (SECONDS - 1) / FPS
    )
    return path


def test_the_file_holds_every_frame_and_the_last_for_longer(video):
    images = list(images_of(video))
    assert len(images) == SECONDS + LAST_FRAMES
    assert images[0].shape == (HEIGHT, WIDTH, 3)
    assert np.allclose(images[40][80, 160], (200, 0, 0), atol=25)


def test_a_long_mission_is_shown_evenly_and_to_its_end():
    assert list(evenly(300, 4)) == [0, 1, 2, 3]
    assert list(evenly(3, 8)) == [1, 4, 7]
    assert list(evenly(3, 0)) == []


def test_a_failure_leaves_no_open_file(tmp_path):
    def snapshots():
        yield snapshot_at(0.0)
        raise ValueError("no more")

    with pytest.raises(ValueError, match="no more"):
        write_video(tmp_path / "broken.webm", snapshots(), RoverScene(WINDOW))


PIXEL = """new Promise((resolve, reject) => {
  const video = document.querySelector("video");
  video.addEventListener("seeked", () => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
    const context = canvas.getContext("2d");
    context.drawImage(video, 0, 0);
    const at = (x, y) => [...context.getImageData(x, y, 1, 1).data.slice(0, 3)];
    resolve([canvas.width, canvas.height, video.duration, at(160, 80), at(480, 80), at(800, 150)]);
  });
  video.addEventListener("error", () => reject(video.error.message));
  video.currentTime = 2;
})"""


async def _played(video: Path) -> list:
    address = (video.parent / "page.html").as_uri()
    (video.parent / "page.html").write_text(f'<video src="{video.name}" preload="auto"></video>')
    async with chromium(arguments=("--allow-file-access-from-files",)) as browser:
        page = await browser.new_page()
        await page.open(address)
        assert await page.becomes("document.querySelector('video').readyState >= 2")
        return await page.evaluate(PIXEL)


@pytest.mark.skipif(browser_tools.executable() is None, reason="no browser")
def test_a_browser_plays_it_and_jumps_within_it(video):
    width, height, duration, camera, vision, ground = asyncio.run(_played(video))
    assert (width, height) == (WIDTH, HEIGHT)
    assert duration == pytest.approx((SECONDS + LAST_FRAMES) / FPS, abs=0.1)
    assert np.allclose(camera, (200, 0, 0), atol=25)
    assert np.allclose(vision, (0, 200, 0), atol=25)
    assert np.allclose(ground, GROUND, atol=25)
