"""Makes the video of a mission from its snapshots."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rover_tools.report.map_layers import Window
from rover_tools.report.video.composition import HEIGHT, WIDTH, Composition
from rover_tools.report.video.snapshot import Snapshot, Video
from rover_tools.report.video.writer import FPS, VideoWriter

VIDEO = "mission.webm"
LAST_FRAMES = 2 * FPS  # for which the end is shown


def write_video(path: Path, snapshots: Iterable[Snapshot], window: Window) -> Video:
    """Write a WebM file with a frame for each snapshot; the last one stays for a while.

    window: the part of the map frame that the map shows.
    """
    composition, frames, picture = Composition(window), 0, None
    with VideoWriter(path, WIDTH, HEIGHT) as video:
        for snapshot in snapshots:
            picture = composition.frame(snapshot)
            video.add(picture)
            frames += 1
        if picture is not None:
            for _ in range(LAST_FRAMES):
                video.add(picture)
    return Video(path.name, max(0, frames - 1) / FPS)
