"""The comparison of recorded and simulated tilts."""

from pathlib import Path

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_common.vehicle import ROVER
from rover_simulator.recordings.recording import RecordedFrame
from rover_simulator.world.terrain import COUNT, Terrain
from rover_tools.benchmarks.pictures import RUNS
from rover_tools.benchmarks.tilt import simulated_tilts, table, tilt_agreement, wall_distances

HALL = np.zeros((200, 200), bool)
HALL[80:120, 80:120] = True


def led(x: float) -> np.ndarray:
    """Tilts of a body that is led north at 2 m/s, turning left, at a distance east."""
    frames = tuple(
        RecordedFrame(Path(), 0.1 * i, Pose(x, 90 + 0.2 * i, np.pi / 2), 2.0, 0.5, 0.0, 0.2)
        for i in range(40)
    )
    terrain = Terrain.of(HALL, relief=np.ones((COUNT, COUNT)))
    return simulated_tilts(frames, terrain)


def test_distances_are_negative_where_there_are_walls():
    places = np.array([(100.0, 100.0), (119.0, 100.0), (121.0, 100.0), (100.0, 78.5)])
    assert wall_distances(HALL, places) == pytest.approx([20.0, 1.0, -1.0, -1.5], abs=0.07)


def test_a_body_that_is_led_leans_with_the_commands_and_the_ground():
    floor, wall = led(100.0), led(120.4)
    assert len(floor) == 39
    assert floor[-1, 1] < 0.0  # into the left turn
    assert np.abs(floor).max() <= ROVER.pitch_stop
    # with its right wheels on the wall
    assert wall[-1, 1] < -2 * ROVER.roll_stop


def test_simulated_tilts_are_those_of_the_recordings(recordings: Path):
    """On the floor within half a degree; at the wall the body leans, and no more than recorded."""
    truth = recordings / "udacity" / "calibration_images" / "map_bw.png"
    result = tilt_agreement(recordings, RUNS, truth)
    for row in result["tilt_floor"]:
        assert row["frames"] > 1000
        assert row["simulated"] == pytest.approx(row["recorded"], abs=0.5)
    near = {row["to"]: row for row in result["tilt_walls"]}
    for edge in (0.0, -0.25):
        for recorded, simulated in zip(
            near[edge]["recorded"], near[edge]["simulated"], strict=True
        ):
            assert recorded / 3 < simulated < 1.2 * recorded
    assert len(table(result).splitlines()) == 1 + 2 + len(near)
