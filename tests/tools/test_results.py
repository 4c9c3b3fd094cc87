"""What a run leaves behind: scores, map files, pictures."""

import json

import cv2
import numpy as np
import pytest
import yaml

from rover_common.types import GridMap, RockTrack
from rover_tools.evaluation.map_files import save_map_server_pair
from rover_tools.evaluation.results import SamplesError, Truth, load_samples, score, write_results

ROCK = RockTrack(1, 20.4, 30.0, (0.01, 0.0, 0.0, 0.01), 5, 0)


def grid_with(free: tuple[slice, slice], occupied: tuple[slice, slice]) -> GridMap:
    cells = np.full((200, 200), -1, np.int8)
    cells[free] = 0
    cells[occupied] = 100
    return GridMap(1.0, 0.0, 0.0, cells)


def truth_with(free: tuple[slice, slice]) -> np.ndarray:
    truth = np.zeros((200, 200), bool)
    truth[free] = True
    return truth


def test_scores_against_the_truth():
    grid = grid_with(np.s_[10:20, 10:20], np.s_[20:22, 10:20])
    truth = Truth(truth_with(np.s_[10:30, 10:15]), np.array([[20.0, 30.0], [80.0, 80.0]]))
    result = score(grid, (ROCK,), truth)
    assert (result["percent_mapped"], result["fidelity"], result["f1"]) == (50.0, 50.0, 50.0)
    assert (result["rocks_located"], result["rocks_missed"], result["rocks_false"]) == (1, 1, 0)


def test_without_a_truth_scores_are_null():
    result = score(None, (), Truth())
    assert result["percent_mapped"] is None
    assert result["rocks_false"] is None


def test_map_server_pair_has_the_north_edge_first(tmp_path):
    save_map_server_pair(grid_with(np.s_[0:1, :], np.s_[199:200, :]), tmp_path / "worldmap")
    image = cv2.imread(str(tmp_path / "worldmap.pgm"), cv2.IMREAD_UNCHANGED)
    description = yaml.safe_load((tmp_path / "worldmap.yaml").read_text())
    assert image.shape == (200, 200)
    assert (image[199] == 254).all()
    assert (image[0] == 0).all()
    assert (image[1:199] == 205).all()
    assert description["image"] == "worldmap.pgm"
    assert description["resolution"] == 1.0
    # As map_server reads the pixels back in trinary mode
    occupancy = (255 - image.astype(float)) / 255
    assert (occupancy[199] < description["free_thresh"]).all()
    assert (occupancy[0] > description["occupied_thresh"]).all()
    middle = occupancy[1:199]
    assert (middle > description["free_thresh"]).all()
    assert (middle < description["occupied_thresh"]).all()


@pytest.mark.parametrize("with_truth", [True, False])
def test_result_folder(tmp_path, with_truth):
    grid = grid_with(np.s_[10:20, 10:20], np.s_[20:22, 10:20])
    truth = (
        Truth(truth_with(np.s_[10:20, 10:20]), np.array([[20.0, 30.0]])) if with_truth else Truth()
    )
    track = np.array([[11.0, 11.0], [15.0, 15.0]])
    write_results(tmp_path, {"frames": 2}, grid, track, (ROCK,), truth, "a run")
    assert json.loads((tmp_path / "result.json").read_text()) == {"frames": 2}
    picture = cv2.imread(str(tmp_path / "map.png"))
    assert picture is not None
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 5


@pytest.mark.parametrize("text", ["a,b\n1,2\n", "x,y\n1,far\n", "x,y\n1\n"])
def test_bad_samples_file(tmp_path, text):
    path = tmp_path / "samples.csv"
    path.write_text(text)
    with pytest.raises(SamplesError, match=r"samples\.csv"):
        load_samples(path)
