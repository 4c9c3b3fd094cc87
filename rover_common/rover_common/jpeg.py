"""JPEG files of pictures that are drawn: lines of a pixel, sharp edges between colours."""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image


def sharp_jpeg(picture: NDArray[np.uint8], quality: int) -> bytes:
    """A JPEG file of a picture (height, width, 3) RGB, its colours at full resolution.

    OpenCV has had an option for the colours' resolution since 4.7; Ubuntu 24.04 has 4.6.
    """
    file = io.BytesIO()
    Image.fromarray(picture).save(file, "JPEG", quality=quality, subsampling="4:4:4")
    return file.getvalue()
