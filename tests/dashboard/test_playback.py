"""A recording on the page shows at each position what the live page showed then."""

from __future__ import annotations

import asyncio
from array import array
from bisect import bisect_left
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest
from nav_msgs.msg import OccupancyGrid
from rclpy.serialization import serialize_message
from rover_interfaces.msg import DriveCommand, MissionState, RoverStatus
from sensor_msgs.msg import CompressedImage

from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions
from rover_common.ros.sensor_checks import JPEG_BEGIN
from rover_dashboard.feed import Feed, Seen
from rover_dashboard.log import Cursor
from rover_dashboard.playback import SPEEDS, Playback, PlaybackError
from rover_dashboard.protocol import MissionRequest, PlaybackChange

SECOND = 1_000_000_000
FPS = 5
SECONDS = 60  # of the recording, which was made at ten times real time
FIRST_STAMP = 7 * SECOND
WAIT = 20.0  # [s]


@dataclass(frozen=True)
class Kept:
    topic: str
    log_time: int
    publish_time: int
    data: bytes


@dataclass
class Recorded:
    """A Source in memory."""

    kept: list[Kept] = field(default_factory=list)
    read: int = 0  # records that were handed out

    def add(self, topic: str, log_time: int, stamp: int, message: Any) -> None:
        self.kept.append(Kept(f"/a/{topic}", log_time, stamp, bytes(serialize_message(message))))

    def records(self, wanted=None, start=None) -> Iterator[Kept]:
        times = [kept.log_time for kept in self.kept]
        for kept in self.kept[0 if start is None else bisect_left(times, start) :]:
            if kept.topic in wanted:
                self.read += 1
                yield kept


def grid_of(known: int) -> OccupancyGrid:
    grid = OccupancyGrid(data=array("b", [0] * known + [-1] * (100 - known)))
    grid.info.width = grid.info.height = 10
    grid.info.resolution = 1.0
    return grid


def recorded(run_2_at: int = 40) -> Recorded:
    """A straight drive; the second run begins after so many seconds."""
    made = Recorded()
    for frame in range(SECONDS * FPS + 1):
        stamp = FIRST_STAMP + frame * SECOND // FPS
        at = 100 * SECOND + frame * SECOND // (10 * FPS)
        second = frame / FPS
        run, start = (1, 0) if second < run_2_at else (2, run_2_at)
        status = RoverStatus(
            header=conversions.header_of(stamp, "base_link"), run=run,
            run_start=conversions.time_of(FIRST_STAMP + start * SECOND),
        )  # fmt: skip
        pose = Pose(10.0 + second, 50.0, 0.0)
        made.add(topics.ODOMETRY, at, stamp, conversions.odometry_of(stamp, pose, 1.0))
        made.add(topics.STATUS, at, stamp, status)
        image = CompressedImage(data=array("B", JPEG_BEGIN + f"image {frame}".encode()))
        made.add(topics.COMPRESSED_IMAGE, at, stamp, image)
        command = DriveCommand(frame_stamp=conversions.time_of(stamp))
        made.add(topics.COMMAND, at + 4_000_000, stamp, command)
        if frame % (10 * FPS) == 0:
            grid = grid_of(frame // FPS + 1)
            made.add(topics.WORLDMAP, at + 5_000_000, stamp, grid)
            state = MissionState(
                header=conversions.header_of(stamp, "map"), run=run, state_name=f"S{frame // FPS}"
            )
            made.add(topics.MISSION_STATE, at + 5_000_000, stamp, state)
    return made


def playing(test: Callable) -> Callable[[], None]:
    """Run a test, a coroutine function of a Playback, beside the playback."""

    def run() -> None:
        async def main() -> None:
            source = recorded()
            playback = Playback(source, {kept.topic for kept in source.kept})
            task = asyncio.create_task(playback.run())
            try:
                await asyncio.wait_for(test(playback, source), WAIT)
            finally:
                task.cancel()

        asyncio.run(main())

    run.__name__ = test.__name__
    return run


async def go_to(playback: Playback, position: float) -> None:
    answer = await playback.carry_out(PlaybackChange("position", position))
    assert answer.ok
    shown = min(max(position, 0.0), playback.end)
    while playback.slots.get("playback").value["position"] != shown:
        await asyncio.sleep(0.01)


def x_of(playback: Playback) -> float:
    return playback.slots.get("vehicle").value["x"]


def rows_of(playback: Playback, log: str) -> list:
    news = playback.history.since(log, Cursor())
    return news.rows if news else []


@playing
async def test_a_position_shows_what_had_come_by_then(playback, _):
    assert playback.end == SECONDS
    await go_to(playback, 25.0)
    assert x_of(playback) == 35.0
    assert playback.slots.get("camera").value.data == JPEG_BEGIN + b"image 125"
    assert (playback.slots.get("map").value.grid.cells == 0).sum() == 21
    assert playback.slots.get("mission").value["state"] == "S20"
    assert [row[1] for row in rows_of(playback, "timeline")] == ["S0", "S10", "S20"]
    assert rows_of(playback, "track")[-1] == (34.8, 50.0)  # 0.2 m a frame, 0.25 m a point
    assert rows_of(playback, "plots")[-1][3:] == (pytest.approx(10 * FPS), 4.0, 4.6)  # at 24.6 s


@playing
async def test_going_back_shows_the_same_as_before(playback, _):
    await go_to(playback, 15.0)
    before = [rows_of(playback, log) for log in ("track", "plots", "timeline")]
    await go_to(playback, 55.0)
    assert rows_of(playback, "timeline")[0][1] == "S40"  # of the second run
    assert rows_of(playback, "track")[0] == (50.0, 50.0)
    await go_to(playback, 15.0)
    assert [rows_of(playback, log) for log in ("track", "plots", "timeline")] == before
    assert playback.slots.get("camera").value.data == JPEG_BEGIN + b"image 75"
    assert playback.slots.get("mission").value["state"] == "S10"


@playing
async def test_positions_outside_are_the_ends(playback, _):
    await go_to(playback, 1e6)
    assert x_of(playback) == 70.0
    assert playback.slots.get("mission").value["state"] == "S60"  # after the last frame
    await go_to(playback, -5.0)
    assert x_of(playback) == 10.0


@playing
async def test_it_plays_to_its_end_and_again_from_the_beginning(playback, _):
    await playback.carry_out(PlaybackChange("speed", SPEEDS[-1]))
    await go_to(playback, 58.0)
    await playback.carry_out(PlaybackChange("playing", 1))
    while playback.playing:
        await asyncio.sleep(0.01)
    assert x_of(playback) == 70.0
    await playback.carry_out(PlaybackChange("playing", 1))
    while not 10.0 < x_of(playback) < 70.0:
        await asyncio.sleep(0.01)
    assert playback.playing


@playing
async def test_images_that_are_passed_over_are_not_read(playback, source):
    await go_to(playback, 1.0)
    source.read = 0
    await go_to(playback, 55.0)
    await go_to(playback, 56.0)
    assert source.read < 20 * FPS  # of 275 in between: those since the newest map


@playing
async def test_images_of_a_position_do_not_grow_old(playback, _):
    await go_to(playback, 30.0)
    assert playback.slots.age(playback.slots.get("camera")) == 0.0


@playing
async def test_nothing_can_be_driven(playback, _):
    answer = await playback.carry_out(MissionRequest("reset"))
    assert not answer.ok
    assert "recording" in answer.text


@playing
async def test_a_viewer_is_told_the_position(playback, _):
    await go_to(playback, 12.0)
    texts = [m for m in Feed(playback.slots, playback.history).news(Seen()) if isinstance(m, str)]
    assert any('"slot":"playback"' in text and '"position":12.0' in text for text in texts)


@pytest.mark.parametrize("names", [set(), {"/a/odom"}])
def test_a_recording_without_a_rover_is_refused(names):
    with pytest.raises(PlaybackError, match="recording"):
        Playback(Recorded(), names)
