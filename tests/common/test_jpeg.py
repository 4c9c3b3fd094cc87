"""JPEG files of drawn pictures."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image, JpegImagePlugin

from rover_common.jpeg import sharp_jpeg


def test_a_line_of_a_pixel_keeps_its_colour():
    picture = np.zeros((48, 64, 3), np.uint8)
    picture[:, 21] = (235, 30, 30)
    image = Image.open(io.BytesIO(sharp_jpeg(picture, 85)))
    assert JpegImagePlugin.get_sampling(image) == 0  # 4:4:4
    decoded = np.asarray(image).astype(int)
    assert np.abs(decoded[:, 21] - picture[:, 21]).max() < 40
    assert decoded[:, [19, 23]].max() < 40
