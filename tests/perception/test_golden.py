"""Replay of a recorded drive: the results equal those of the committed file, within tolerances.

`pytest tests/perception/test_golden.py --update-golden` writes the file anew after an intended
change; `tests/golden/make.py` records the drive anew.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from rover_common.map_encoding import EDGE, navigable_cells
from rover_common.types import CameraFrame, FreeScan, GridMap, PerceptionResult
from rover_perception.config import PerceptionConfig
from rover_perception.perception import Perception
from rover_simulator.recordings.recording import read_recording

GOLDEN = Path(__file__).resolve().parents[1] / "golden"
EXPECTED = GOLDEN / "expected.json"
BEARINGS_DEG = (-40, -20, 0, 20, 40)
EVERY = 10  # frames between two whose results are compared
# JPEG decoders differ by a level, which moves the end of the ground by a fraction of a row.
COUNT = {"rel": 0.02, "abs": 4}  # cells and points
DISTANCE = {"rel": 0.03, "abs": 0.05}  # [m]
POSITION = {"abs": 0.05}  # [m]


@pytest.fixture(scope="module")
def replayed(request: pytest.FixtureRequest) -> dict[str, Any]:
    """The results of the replay, which are the expected ones from now on with --update-golden."""
    results = _replay()
    if request.config.getoption("--update-golden"):
        EXPECTED.write_text(json.dumps(results, indent=1) + "\n")
    return results


@pytest.fixture(scope="module")
def expected(replayed) -> dict[str, Any]:
    return json.loads(EXPECTED.read_text())


def _replay() -> dict[str, Any]:
    core = Perception(PerceptionConfig(image_lag=0))
    frames = []
    for index, recorded in enumerate(read_recording(GOLDEN / "drive").frames):
        image = cv2.cvtColor(cv2.imread(str(recorded.image_path)), cv2.COLOR_BGR2RGB)
        result = core.process(CameraFrame(1 + index * 40_000_000, recorded.pose, image))
        if index % EVERY == 0:
            frames.append(_frame_of(index, result))
    return {
        "world_map": _counts_of(core.world_map()),
        "navigation_map": _counts_of(core.navigation_map()),
        "rocks": [
            {
                "id": rock.id,
                "x": round(rock.x, 3),
                "y": round(rock.y, 3),
                "observations": rock.observations,
            }
            for rock in result.rocks
        ],
        "frames": frames,
    }


def _counts_of(grid: GridMap) -> dict[str, int]:
    masks = {
        "known": grid.cells >= 0,
        "free": navigable_cells(grid.cells),
        "edge": grid.cells == EDGE,
        "occupied": grid.cells > EDGE,
    }
    return {name: int(np.count_nonzero(mask)) for name, mask in masks.items()}


def _frame_of(index: int, result: PerceptionResult) -> dict[str, Any]:
    return {
        "index": index,
        "nav_points": len(result.nav.ranges),
        "rock_points": len(result.rock.ranges),
        "rocks": len(result.rocks),
        "free_distance": [_distance_at(result.scan, bearing) for bearing in BEARINGS_DEG],
    }


def _distance_at(scan: FreeScan, bearing_deg: float) -> float | None:
    """[m]; None where the ground extends beyond the range of the scan."""
    index = round((np.radians(bearing_deg) - scan.angle_min) / scan.angle_increment)
    distance = float(scan.ranges[index])
    return round(distance, 3) if np.isfinite(distance) else None


@pytest.mark.parametrize("name", ["world_map", "navigation_map"])
def test_the_maps_have_the_expected_numbers_of_cells(replayed, expected, name):
    for kind, count in expected[name].items():
        assert replayed[name][kind] == pytest.approx(count, **COUNT), kind


def test_the_rocks_are_the_expected_ones(replayed, expected):
    assert [rock["id"] for rock in replayed["rocks"]] == [rock["id"] for rock in expected["rocks"]]
    for found, rock in zip(replayed["rocks"], expected["rocks"], strict=True):
        assert (found["x"], found["y"]) == pytest.approx((rock["x"], rock["y"]), **POSITION)
        assert found["observations"] == pytest.approx(rock["observations"], abs=2)


def test_each_frame_has_the_expected_points_and_free_distances(replayed, expected):
    assert len(replayed["frames"]) == len(expected["frames"]) == 6
    for found, frame in zip(replayed["frames"], expected["frames"], strict=True):
        assert found["nav_points"] == pytest.approx(frame["nav_points"], **COUNT), frame["index"]
        assert found["rock_points"] == frame["rock_points"], frame["index"]
        assert found["rocks"] == frame["rocks"], frame["index"]
        for distance, wanted in zip(found["free_distance"], frame["free_distance"], strict=True):
            assert distance == (wanted and pytest.approx(wanted, **DISTANCE)), frame["index"]
