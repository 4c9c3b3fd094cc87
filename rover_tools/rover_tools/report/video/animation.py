"""Makes the animated picture of the README from a mission's video.

python -m rover_tools.report.video.animation RESULTS/mission.webm docs/images/mission.webp
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import av
import click
import cv2
import numpy as np
from av.video.frame import VideoFrame
from av.video.stream import VideoStream

from rover_tools.report.video.snapshot import Image

OPTIONS = {"loop": "0", "quality": "75", "preset": "picture"}


@click.command()
@click.argument("video", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.argument("picture", type=click.Path(dir_okay=False, path_type=Path))
@click.option("--frames", type=int, default=80, help="About as many frames of the video.")
@click.option("--fps", type=int, default=8, help="Frames per second of the picture.")
@click.option("--width", type=int, default=720, help="[px]")
def main(video: Path, picture: Path, frames: int, fps: int, width: int) -> None:
    """Make an animated WebP of a video."""
    count = sum(1 for _ in images_of(video))
    chosen = [
        image for at, image in enumerate(images_of(video)) if at % max(1, count // frames) == 0
    ]
    height = round(width * chosen[0].shape[0] / chosen[0].shape[1])
    with av.open(str(picture), "w", format="webp") as container:
        stream = container.add_stream("libwebp_anim", rate=fps, options=OPTIONS)
        assert isinstance(stream, VideoStream)
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        for image in chosen:
            resized = cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA)
            small = np.asarray(resized, np.uint8)
            container.mux(stream.encode(VideoFrame.from_ndarray(small, format="rgb24")))
        container.mux(stream.encode(None))
    click.echo(f"{picture}: {len(chosen)} frames, {picture.stat().st_size / 1e6:.2f} MB", err=True)


def images_of(video: Path) -> Iterator[Image]:
    """Its frames (height, width, 3) RGB, one after another."""
    with av.open(str(video)) as container:
        for frame in container.decode(video=0):
            yield np.asarray(frame.to_ndarray(format="rgb24"), np.uint8)


if __name__ == "__main__":
    main()
