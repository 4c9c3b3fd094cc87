"""Pictures of any encoding with 8 bits a colour, checked and read."""

from __future__ import annotations

import numpy as np
from sensor_msgs.msg import Image

from rover_common.ros.check_values import check_header
from rover_common.ros.message_errors import EncodingError, SizeError

# Order of the colours' bytes in a pixel, red first; a grey one has one byte for all three.
ENCODINGS = {
    "rgb8": (3, (0, 1, 2)),
    "bgr8": (3, (2, 1, 0)),
    "rgba8": (4, (0, 1, 2)),
    "bgra8": (4, (2, 1, 0)),
    "8UC3": (3, (2, 1, 0)),  # OpenCV's own order, as cv_bridge takes it
    "mono8": (1, (0, 0, 0)),
    "8UC1": (1, (0, 0, 0)),
}
MOST_BYTES = 100_000_000


def check_image(message: Image) -> None:
    """Any legal step: rows may end with bytes of no meaning."""
    if message.encoding not in ENCODINGS:
        raise EncodingError(f"encoding '{message.encoding:.40}', not {', '.join(ENCODINGS)}")
    channels, _ = ENCODINGS[message.encoding]
    height, width, step = message.height, message.width, message.step
    if not (height > 0 and width > 0 and step >= channels * width):
        raise SizeError(f"{height} rows of {step} bytes for {width} pixels")
    if not len(message.data) == height * step <= MOST_BYTES:
        raise SizeError(f"{len(message.data)} bytes for {height} rows of {step}")
    check_header(message.header)


def image_of(message: Image) -> np.ndarray:
    """(height, width, 3) uint8 RGB, read-only, of any encoding of ENCODINGS; raises MessageError.

    A view of the message where its pixels are RGB without bytes between the rows.
    """
    check_image(message)
    channels, order = ENCODINGS[message.encoding]
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    used = rows[:, : channels * message.width]
    pixels = used.reshape(message.height, message.width, channels)
    rgb = pixels if (channels, order) == ENCODINGS["rgb8"] else pixels[:, :, order]
    image = np.ascontiguousarray(rgb)
    image.flags.writeable = False
    return image
