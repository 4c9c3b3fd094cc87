"""The camera's JPEG files."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image, JpegImagePlugin

from rover_simulator.sensors.jpeg import encode_jpeg


def test_the_files_are_coded_as_the_unity_simulators():
    image = Image.open(io.BytesIO(encode_jpeg(np.zeros((160, 320, 3), np.uint8))))
    assert JpegImagePlugin.get_sampling(image) == 2  # 4:2:0
    luminance = np.array(image.quantization[0])
    assert (luminance[0], luminance[63]) == (8, 50)  # of quality 75: half of the standard's table
