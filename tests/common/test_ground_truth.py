"""True maps as people have them: two values in any depth, or one line that says why not."""

import cv2
import numpy as np
import pytest

from rover_common.ground_truth import TruthError, load_truth

FREE = np.zeros((200, 200), bool)
FREE[80:120, 60:140] = FREE[100:105, 20:60] = True
WALL = (cv2.dilate(FREE.astype(np.uint8), np.ones((3, 3))) > 0) & ~FREE
COLOURS = np.where(FREE[..., None], (0, 255, 255), (60, 0, 0)).astype(np.uint8)


def grey(free: int, other: int, kind: type = np.uint8) -> np.ndarray:
    return np.where(FREE, free, other).astype(kind)


def written(folder, image, name="map.png", *options):
    cv2.imwrite(str(folder / name), image, options)
    return folder / name


@pytest.mark.parametrize(
    "image",
    [
        grey(255, 0), grey(1, 0), grey(255, 64), grey(255, 0, np.uint16), grey(900, 9, np.uint16),
        COLOURS, np.dstack([COLOURS, np.full(FREE.shape, 255, np.uint8)]),
    ],
    ids=["255", "1", "grey walls", "16 bit", "16 bit of two greys", "colours", "opaque"],
)  # fmt: skip
def test_the_brighter_of_two_values_is_navigable(tmp_path, image):
    assert np.array_equal(load_truth(written(tmp_path, image)), FREE)


def test_one_bit_is_read(tmp_path):
    path = written(tmp_path, grey(255, 0), "map.png", cv2.IMWRITE_PNG_BILEVEL, 1)
    assert np.array_equal(load_truth(path), FREE)


@pytest.mark.parametrize(
    ("name", "image", "reason"),
    [
        ("map.jpg", grey(255, 0), "values, not two"),
        ("map.pgm", np.where(WALL, 0, grey(254, 205)).astype(np.uint8), "of map_server"),
        ("map.png", np.dstack([np.full((200, 200, 3), 255), grey(255, 0)]), "transparent"),
        ("map.png", np.dstack([*[grey(255, 0)] * 3, grey(255, 0)]), "transparent"),
        ("map.png", np.where(WALL, 90, grey(255, 0)).astype(np.uint8), "3 values, not two"),
        ("map.png", np.dstack([grey(0, 90), grey(90, 0), grey(0, 0)]), "2 values, not two"),
        ("map.png", np.full((200, 200), 255, np.uint8), "no navigable cell: all pixels are 255"),
        ("map.png", np.zeros((200, 300), np.uint8), "300 x 200 pixels, expected 200 x 200"),
    ],
    ids=["JPEG", "map_server", "alpha alone", "alpha", "three", "as bright", "one", "size"],
)
def test_other_pictures_are_refused_with_the_reason(tmp_path, name, image, reason):
    with pytest.raises(TruthError, match=reason) as caught:
        load_truth(written(tmp_path, image, name))
    assert str(tmp_path / name) in str(caught.value)
    assert "\n" not in str(caught.value)
