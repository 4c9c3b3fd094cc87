"""Scores, as the simulator's community counts them, and rocks one to one."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra.numpy import arrays

from rover_common.ground_truth import TruthError, load_truth
from rover_common.map_encoding import navigable_cells
from rover_tools.evaluation.scoring import score_map, score_places

MAPS = arrays(bool, (8, 8))


def test_navigable_is_zero_to_forty_nine():
    cells = np.array([[-1, 0, 49, 50, 100]], np.int8)
    assert navigable_cells(cells).tolist() == [[False, True, True, False, False]]


@given(MAPS, MAPS)
def test_scores_are_shares(navigable, truth):
    truth[0, 0] = True
    score = score_map(navigable, truth)
    assert 0 <= score.percent_mapped <= 100
    assert 0 <= score.fidelity <= 100
    assert score.f1 <= max(score.percent_mapped, score.fidelity) + 1e-9


def test_a_perfect_map():
    truth = np.eye(5, dtype=bool)
    score = score_map(truth, truth)
    assert (score.percent_mapped, score.fidelity, score.f1) == (100, 100, 100)


def points(*xy: tuple[float, float]) -> np.ndarray:
    return np.array(xy, float).reshape(-1, 2)


@pytest.mark.parametrize(
    ("found", "true", "expected"),
    [
        (points(), points(), (0, 0, 0)),
        (points((1, 1)), points(), (0, 0, 1)),
        (points(), points((1, 1)), (0, 1, 0)),
        (points((1.5, 1)), points((1, 1)), (1, 0, 0)),
        (points((2.5, 1)), points((1, 1)), (0, 1, 1)),
        (points((1, 1), (1.2, 1)), points((1, 1)), (1, 0, 1)),  # one rock, one entry
        # the nearer pair must not take the only match of the other
        (points((0, 0), (0.9, 0)), points((0.8, 0), (1.7, 0)), (2, 0, 0)),
    ],
)
def test_rocks(found, true, expected):
    score = score_places(found, true)
    assert (score.located, score.missed, score.false) == expected


def test_truth_is_read_unflipped(tmp_path):
    image = np.zeros((200, 200), np.uint8)
    image[3, 150] = 255
    cv2.imwrite(str(tmp_path / "map.png"), image)
    truth = load_truth(tmp_path / "map.png")
    assert np.argwhere(truth).tolist() == [[3, 150]]


@pytest.mark.parametrize("kind", ["missing", "text", "small", "black"])
def test_a_bad_truth_is_one_clear_error(tmp_path, kind, capfd):
    path = tmp_path / "map.png"
    if kind == "text":
        path.write_text("no picture")
    if kind in ("small", "black"):
        size = 20 if kind == "small" else 200
        cv2.imwrite(str(path), np.zeros((size, size), np.uint8))
    with pytest.raises(TruthError, match=r"map\.png"):
        load_truth(path)
    assert capfd.readouterr().err == ""  # also nothing of OpenCV's own
