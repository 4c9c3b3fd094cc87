"""The camera's JPEG files, as the Unity simulator writes them: quality 75, 4:2:0."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

QUALITY = 75
BLOCK = 16  # [px] rows and columns that are coded together, with colour at half resolution


def encode_jpeg(image: NDArray[np.uint8]) -> bytes:
    """A JPEG file of an image (height, width, 3) RGB."""
    parameters = [cv2.IMWRITE_JPEG_QUALITY, QUALITY]  # 4:2:0 is the default
    _, data = cv2.imencode(".jpg", cv2.cvtColor(image, cv2.COLOR_RGB2BGR), parameters)
    return data.tobytes()


def first_row_to_encode(row: int) -> int:
    """From which row on an image must be right for its decoded pixels to be right from `row` on.

    Blocks are coded independently, but the decoder interpolates colour across their edges: the
    first row of pixels of a block depends on the block above it.
    """
    return max(0, row - 1) // BLOCK * BLOCK
