"""Pictures that are none, that claim much, or that end early: seen before they are decoded."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from telemetry import IMAGE, claiming, jpeg

from rover_bridge import codec
from rover_bridge.errors import ImageSizeError, JpegError, TelemetryError
from rover_bridge.jpeg_header import END, MAX_BYTES, START, read_header

FRAME = IMAGE.index(b"\xff\xc0")
SCAN = IMAGE.index(b"\xff\xda") + 14  # where the coded picture begins


@pytest.fixture
def no_decoder(monkeypatch):
    """Fails when a picture is decoded."""

    def decode(*_: object) -> None:
        raise AssertionError("decoded")

    monkeypatch.setattr(codec.cv2, "imdecode", decode)


def test_the_header_of_a_picture():
    header = read_header(IMAGE)
    assert (header.width, header.height, header.components) == (320, 160, 3)


def test_a_grey_picture_is_decoded():
    grey = cv2.imencode(".jpg", np.full((160, 320), 90, np.uint8))[1].tobytes()
    assert read_header(grey).components == 1
    assert codec.decode_jpeg(grey).shape == (160, 320, 3)


@pytest.mark.parametrize(
    ("width", "height"), [(32760, 32760), (20000, 20000), (160, 320), (0, 0), (320, 161)]
)
def test_a_picture_of_another_size_is_not_decoded(no_decoder, width, height):
    with pytest.raises(ImageSizeError, match=f"{width} x {height}"):
        codec.decode_jpeg(claiming(width, height))


@pytest.mark.parametrize(
    "data",
    [
        b"",
        START,
        START + END,
        IMAGE[:FRAME] + IMAGE[FRAME:].replace(b"\xff\xc0", b"\xff\xc2", 1),  # progressive
        IMAGE[:FRAME] + IMAGE[FRAME:].replace(b"\xff\xc0", b"\xff\xc9", 1),  # arithmetic
        IMAGE[:FRAME] + IMAGE[FRAME : FRAME + 19] + IMAGE[FRAME:],  # two frames
        IMAGE[:FRAME] + b"\x00" + IMAGE[FRAME:],
        START + b"\xff\xe0\x00\x01" + END,
        IMAGE[:-2] + b"\x00" * MAX_BYTES + END,
        cv2.imencode(".png", np.zeros((160, 320, 3), np.uint8))[1].tobytes(),
    ],
    ids=range(10),
)
def test_what_is_no_sequential_jpeg_is_not_decoded(no_decoder, data):
    with pytest.raises(JpegError):
        codec.decode_jpeg(data)


@given(st.binary(max_size=200), st.integers(0, len(IMAGE)))
def test_any_bytes_are_read_or_an_error(data, cut):
    for damaged in (data, START + data + END, IMAGE[:cut] + data + END):
        try:
            read_header(damaged)
        except JpegError:
            continue
        assert damaged.startswith(START)


@pytest.mark.parametrize("share", [0.0, 0.2, 0.4, 0.6, 0.8, 0.95])
def test_a_picture_cut_short_is_refused(share):
    cut = SCAN + int(share * (len(IMAGE) - SCAN))
    with pytest.raises(JpegError, match="before its last row"):
        codec.decode_jpeg(IMAGE[:cut] + END)


def test_a_picture_cut_within_a_coded_byte_is_refused():
    cut = IMAGE.index(b"\xff\x00", SCAN)
    with pytest.raises(JpegError, match="before its last row"):
        codec.decode_jpeg(IMAGE[: cut + 1] + END)


@given(st.integers(SCAN, len(IMAGE) - 64))
def test_a_picture_cut_anywhere_before_its_last_block_is_refused(cut):
    with pytest.raises(TelemetryError):
        codec.decode_jpeg(IMAGE[:cut] + END)


@pytest.mark.parametrize("level", [0, 128, 255])
def test_a_picture_that_is_grey_is_not_taken_for_one_cut_short(level):
    flat = cv2.imencode(".jpg", np.full((160, 320, 3), level, np.uint8))[1].tobytes()
    assert np.all(codec.decode_jpeg(flat) == level)
    assert codec.decode_jpeg(jpeg(128)).shape == (160, 320, 3)
