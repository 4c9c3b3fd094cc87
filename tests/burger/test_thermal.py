"""What the thermal sensors say, against the warm patches."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from sensor_runs import frames, run
from worlds import square, warm_wall_ahead

from burger_simulator.options import BurgerOptions
from burger_simulator.simulation import BurgerSimulation
from burger_simulator.world.maze import SensorErrors, Wall
from rover_common.geometry import Pose
from rover_common.sensor_types import Twist


def test_a_warm_patch_is_where_it_is_in_the_picture():
    """The patch is ahead, as high as the sensor: in the middle of sensor 2 alone."""
    batches = run(BurgerSimulation(square(sources=(warm_wall_ahead(),)), 1), 3.0)
    ahead, left = frames(batches, 2).mean(axis=0), frames(batches, 1).mean(axis=0)
    assert ahead[3:5, 3:5].min() > 28.0
    assert ahead[0].max() < 23.5
    assert left.max() < 23.5
    assert np.abs(ahead - ahead[:, ::-1]).max() < 0.3


def test_rows_go_down_and_columns_to_the_right():
    above = warm_wall_ahead(height=0.4)
    batches = run(BurgerSimulation(square(sources=(above,)), 1), 2.0)
    row, column = np.unravel_index(frames(batches, 2).mean(axis=0).argmax(), (8, 8))
    assert row < 3
    assert column in (3, 4)
    turned = square(sources=(warm_wall_ahead(),), start=Pose(0.0, 0.0, -0.3))
    _, column = np.unravel_index(
        frames(run(BurgerSimulation(turned, 1), 2.0), 2).mean(axis=0).argmax(), (8, 8)
    )
    assert column < 3


@pytest.mark.parametrize("flip", ["none", "rows", "columns", "both"])
def test_a_mirrored_sensor_shows_the_same_mirrored(flip):
    maze = square(sources=(warm_wall_ahead(height=0.4),), start=Pose(0.0, 0.0, -0.3))
    plain = frames(run(BurgerSimulation(maze, 1), 1.0), 2)
    options = BurgerOptions(thermal_flip_2=flip)
    mirrored = frames(run(BurgerSimulation(maze, 1, options), 1.0), 2)
    if flip in ("rows", "both"):
        plain = plain[:, ::-1]
    if flip in ("columns", "both"):
        plain = plain[:, :, ::-1]
    assert (plain == mirrored).all()


def test_a_wall_before_a_patch_hides_it_and_its_other_face_is_cold():
    screen = Wall(0.5, -0.5, 0.5, 0.5)
    hidden = square(sources=(warm_wall_ahead(),), inner=(screen,))
    assert frames(run(BurgerSimulation(hidden, 1), 1.0), 2).max() < 24.0
    on_screen = {**vars(warm_wall_ahead()), "x": 0.5025, "normal": 0.0}
    for both, low, high in ((False, 22.0, 24.0), (True, 30.0, 34.0)):
        source = type(warm_wall_ahead())(**(on_screen | {"both_faces": both}))
        maze = square(sources=(source,), inner=(screen,))
        assert low < frames(run(BurgerSimulation(maze, 1), 1.0), 2).max() < high


def test_a_patch_on_the_other_side_of_the_wall_behind_is_not_seen():
    screen = Wall(0.5, -0.5, 0.5, 0.5)
    source = replace(warm_wall_ahead(), x=0.5025, normal=0.0)
    start = Pose(0.3, 0.0, math.pi)
    maze = square(sources=(source,), inner=(screen,), start=start)
    assert frames(run(BurgerSimulation(maze, 1), 1.0), 2).max() < 24.0


def test_the_offsets_noise_and_steps_of_a_reading():
    errors = SensorErrors(thermal_offsets=(1.5, -2.0))
    options = BurgerOptions(thermal_offset_1=1.0)
    batches = run(BurgerSimulation(square(errors=errors), 1, options), 10.0)
    first, second = frames(batches, 1), frames(batches, 2)
    assert first.mean() == pytest.approx(23.0 + 2.5, abs=0.02)
    assert second.mean() == pytest.approx(23.0 - 2.0, abs=0.02)
    assert (first * 4 == np.round(first * 4)).all()
    assert first.std() == pytest.approx(math.hypot(0.16, 0.25 / math.sqrt(12)), rel=0.05)


def test_frames_arrive_late_ten_times_a_second_or_once():
    batches = run(BurgerSimulation(square()), 3.0)
    stamps = [frame.stamp for batch in batches for frame in batch.thermal if frame.sensor == 1]
    assert stamps[0] == 1_000_000_000 + 100_000_000 + 50_000_000
    assert set(np.diff(stamps).tolist()) == {100_000_000}
    options = BurgerOptions(thermal_rate=1.0, thermal_delay=0.35)
    batches = run(BurgerSimulation(square(), options=options), 3.0)
    stamps = [frame.stamp for batch in batches for frame in batch.thermal if frame.sensor == 2]
    assert stamps == [2_350_000_000, 3_350_000_000]
    assert frames(batches, 1).std() < 0.12


def test_a_dead_sensor_says_nothing():
    for dead in (1, 2):
        options = BurgerOptions(thermal_dead=dead)
        batches = run(BurgerSimulation(square(), options=options), 1.0)
        assert {frame.sensor for batch in batches for frame in batch.thermal} == {3 - dead}


def test_a_turning_sensor_lags_behind_by_its_time_constant():
    """At 1 rad/s the patch appears 0.1 rad behind, and later by the delay."""
    maze = square(sources=(warm_wall_ahead(),), start=Pose(0.0, 0.0, -1.5))
    simulation = BurgerSimulation(maze, 1, BurgerOptions(thermal_delay=0.0))
    columns = np.radians(26.25 - 7.5 * np.arange(8))
    lags = []
    for _ in range(60):
        batch = simulation.step(Twist(0.0, 1.0))
        yaw = simulation.truth.pose.yaw
        for frame in (f for f in batch.thermal if f.sensor == 2 and abs(yaw) < 0.15):
            excess = np.clip(frame.celsius - 24.0, 0.0, None).sum(axis=0)
            lags.append((excess * columns).sum() / excess.sum() + yaw)
    assert np.mean(lags) == pytest.approx(0.1, abs=0.03)
