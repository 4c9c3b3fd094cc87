"""The simulation as a whole: repeatable, and its launcher and truth."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from worlds import ramp_ahead, square

from burger_simulator.launcher import Launcher
from burger_simulator.options import BurgerOptions
from burger_simulator.simulation import TICK, BurgerSimulation
from burger_simulator.truth import TouchCounter
from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose
from rover_common.sensor_types import SensorBatch, Twist


def written(batches: list[SensorBatch]) -> list[bytes]:
    """All bits of what was said."""
    return [
        b"".join(
            [repr((b.stamp, b.imus, b.odometry, b.launches_done)).encode()]
            + [repr(replace(s, ranges=s.ranges.tobytes())).encode() for s in b.scans]
            + [repr((f.stamp, f.sensor)).encode() + f.celsius.tobytes() for f in b.thermal]
        )
        for b in batches
    ]


def wandering(maze: Maze, seed: int, options: BurgerOptions | None = None) -> list[bytes]:
    simulation = BurgerSimulation(maze, seed, options or BurgerOptions())
    return written(
        [
            simulation.step(Twist(0.15 * math.sin(tick / 9), 1.5 * math.cos(tick / 7)), tick == 50)
            for tick in range(150)
        ]
    )


def test_the_same_seed_says_the_same_bit_for_bit(tmp_path):
    maze = generate_maze(7)
    first = wandering(maze, 1)
    assert wandering(generate_maze(7), 1) == first
    assert wandering(maze, 2) != first
    maze.save(tmp_path / "maze.yaml")
    assert wandering(Maze.load(tmp_path / "maze.yaml"), 1) == first


def test_a_fault_of_one_sensor_leaves_the_noise_of_the_others():
    maze = generate_maze(7)
    options = BurgerOptions(thermal_offset_1=2.0, thermal_delay=0.2)
    runs = []
    for chosen in (BurgerOptions(), options):
        simulation = BurgerSimulation(maze, 1, chosen)
        batches = [simulation.step(Twist(0.1, 0.3)) for _ in range(60)]
        runs.append([(b.imus, b.odometry, [s.ranges.tobytes() for s in b.scans]) for b in batches])
    assert runs[0] == runs[1]


def test_time_begins_at_one_second_and_goes_by_ticks():
    simulation = BurgerSimulation(square())
    assert simulation.time == 1.0
    stamps = [simulation.step().stamp for _ in range(5)]
    assert np.diff([1_000_000_000, *stamps]).tolist() == [round(TICK * 1e9)] * 5
    assert simulation.truth.time == simulation.time


def test_a_sequence_takes_ten_seconds_and_a_half_and_a_signal_in_it_is_ignored():
    simulation = BurgerSimulation(square())
    done = []
    for tick in range(500):
        batch = simulation.step(launch=tick in (10, 40))
        done += [batch.stamp] * batch.launches_done
    assert done == [round((1.0 + 10 * 0.05 + 10.5) * 1e9)]
    assert len(simulation.truth.launches) == 1
    simulation.step(launch=True)
    assert len(simulation.truth.launches) == 2


def test_a_launcher_reports_once():
    launcher = Launcher()
    assert launcher.reports(10**12) == 0
    assert launcher.signal(0)
    assert not launcher.signal(1)
    assert launcher.reports(10_499_999_999) == 0
    assert launcher.reports(10_500_000_000) == 1
    assert launcher.reports(10_500_000_001) == 0
    assert launcher.signal(10_500_000_002)


def test_a_launch_is_remembered_as_it_was_signalled():
    simulation = BurgerSimulation(square(5.0))
    for _ in range(40):
        simulation.step(Twist(0.2))
    before = simulation.truth
    simulation.step(Twist(0.2), launch=True)
    (launch,) = simulation.truth.launches
    assert launch.time == before.time
    assert launch.pose == before.pose
    assert launch.speed == pytest.approx(0.2, rel=0.03)


def test_touches_close_in_time_are_one():
    counter = TouchCounter()
    for touching, seconds in ((True, 0.1), (False, 0.4), (True, 0.1), (False, 0.6), (True, 0.1)):
        counter.update(touching, seconds)
    assert counter.count == 2
    assert counter.touching


@pytest.mark.parametrize(
    ("pose", "beyond", "flat"),
    [
        (Pose(0.4, 0.0, 0.0), 0.0, False),  # before the foot
        (Pose(0.8, 0.0, 0.0), 0.3, False),
        (Pose(0.8, 0.32, 0.0), 0.3, False),  # one wheel on it
        (Pose(0.8, 0.34, 0.0), 0.0, False),
        (Pose(1.1, 0.0, 0.0), 0.6, True),
        (Pose(1.04, 0.0, 0.0), 0.54, False),  # the caster on the slope
        (Pose(1.1, 0.0, math.pi), 0.6, True),
        (Pose(1.1, 0.2, 0.0), 0.6, False),  # a wheel beside it
        (Pose(1.9, 0.0, 0.0), 0.0, False),  # over it
    ],
)
def test_where_the_robot_is_on_the_ramp(pose, beyond, flat):
    """It is dropped there, and slides a little."""
    truth = BurgerSimulation(square(3.0, start=pose, ramp=ramp_ahead(0.5))).truth
    assert truth.beyond_foot == pytest.approx(beyond, abs=0.04)
    assert truth.on_flat == flat
