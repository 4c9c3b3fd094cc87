"""Images of every encoding and step that is read are the same picture."""

from __future__ import annotations

from array import array

import numpy as np
import pytest
from cases import CASES, fuzzed
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import Image

from rover_common.ros.images import ENCODINGS, image_of
from rover_common.ros.message_errors import EncodingError, SizeError

COLOR = sorted(name for name, (channels, _) in ENCODINGS.items() if channels > 1)


def message(picture: np.ndarray, encoding: str, padding: int) -> Image:
    """A picture (height, width, 3) RGB; its rows end with `padding` bytes of no meaning."""
    height, width, _ = picture.shape
    channels, order = ENCODINGS[encoding]
    pixels = np.full((height, width, channels), 77, np.uint8)
    pixels[:, :, list(order)] = picture
    rows = np.pad(pixels.reshape(height, -1), ((0, 0), (0, padding)), constant_values=99)
    data = array("B", rows.tobytes())
    return Image(height=height, width=width, encoding=encoding, step=rows.shape[1], data=data)


@fuzzed(CASES * 0.05)
@given(
    st.sampled_from(COLOR), st.integers(1, 9), st.integers(1, 9), st.integers(0, 7),
    st.integers(0, 2**32 - 1),
)  # fmt: skip
def test_a_picture_is_the_same_in_every_encoding_and_step(encoding, height, width, padding, seed):
    picture = np.random.default_rng(seed).integers(0, 256, (height, width, 3)).astype(np.uint8)
    read = image_of(message(picture, encoding, padding))
    assert np.array_equal(read, picture)
    assert read.flags.c_contiguous
    assert not read.flags.writeable


def test_a_grey_picture_has_three_equal_colours():
    grey = np.arange(6, dtype=np.uint8).reshape(2, 3)
    data = array("B", grey.tobytes())
    read = image_of(Image(height=2, width=3, encoding="mono8", step=3, data=data))
    assert np.array_equal(read, np.repeat(grey[:, :, None], 3, axis=2))


@pytest.mark.parametrize(
    "changes",
    [{"step": 8}, {"height": 3}, {"width": 4}, {"height": 0}, {"data": array("B", b"")}],
    ids=str,
)
def test_a_picture_that_does_not_hold_what_it_says_is_refused(changes):
    made = message(np.zeros((2, 3, 3), np.uint8), "rgb8", 0)
    for name, value in changes.items():
        setattr(made, name, value)
    with pytest.raises(SizeError):
        image_of(made)


def test_an_encoding_that_is_not_read_is_refused_by_its_name():
    made = message(np.zeros((2, 3, 3), np.uint8), "rgb8", 0)
    made.encoding = "bayer_rggb8"
    with pytest.raises(EncodingError, match="bayer_rggb8"):
        image_of(made)
