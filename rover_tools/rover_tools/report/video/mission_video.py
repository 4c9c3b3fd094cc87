"""Makes the video of a mission from its snapshots."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rover_common.whole_file import whole_file
from rover_tools.report.video.composition import HEIGHT, WIDTH, Composition, S, Scene
from rover_tools.report.video.snapshot import Video
from rover_tools.report.video.writer import FPS, VideoWriter

VIDEO = "mission.webm"
MOST_FRAMES = 300  # of a video: a longer mission is shown faster, and costs no more
LAST_FRAMES = 2 * FPS  # for which the end is shown


def write_video(path: Path, snapshots: Iterable[S], scene: Scene[S]) -> Video:
    """Write a WebM file with a frame for each snapshot; the last one stays for a while."""
    composition, frames, picture = Composition(scene), 0, None
    with whole_file(path) as draft, VideoWriter(draft, WIDTH, HEIGHT) as video:
        for snapshot in snapshots:
            picture = composition.frame(snapshot)
            video.add(picture)
            frames += 1
        if picture is not None:
            for _ in range(LAST_FRAMES):
                video.add(picture)
    return Video(path.name, max(0, frames - 1) / FPS)


def evenly(most: int, count: int) -> range:
    """At most so many of `count` numbers, evenly, and the last one."""
    step = max(1, -(-count // most))
    return range((count - 1) % step, count, step)
