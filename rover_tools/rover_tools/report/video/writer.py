"""Encodes frames as a video that browsers play."""

from __future__ import annotations

from pathlib import Path
from types import TracebackType

import av
from av.video.frame import VideoFrame
from av.video.stream import VideoStream

from rover_tools.report.video.snapshot import Image

FPS = 20  # frames in a second of the video
# VP9 of libvpx, as fast as it can: about as much time per frame as H.264 with libx264's preset
# veryfast, measured at 960 x 360; the library has a permissive licence.
CODEC = "libvpx-vp9"
OPTIONS = {"deadline": "realtime", "cpu-used": "8", "crf": "34", "b": "0", "row-mt": "1"}
KEY_FRAMES = 100  # frames from one that can be jumped to, to the next


class VideoWriter:
    """A WebM file; it is complete when the block ends."""

    def __init__(self, path: Path, width: int, height: int) -> None:
        """width, height [px], both even."""
        self._container = av.open(str(path), "w", format="webm")
        stream = self._container.add_stream(CODEC, rate=FPS, options=OPTIONS)
        assert isinstance(stream, VideoStream)
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        stream.codec_context.gop_size = KEY_FRAMES
        stream.codec_context.thread_count = 1  # more of them take more time in all
        self._stream = stream

    def add(self, image: Image) -> None:
        """Append a frame (height, width, 3) RGB."""
        frame = VideoFrame.from_ndarray(image, format="rgb24")
        self._container.mux(self._stream.encode(frame))

    def __enter__(self) -> VideoWriter:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is None:
            self._container.mux(self._stream.encode(None))
        self._container.close()
