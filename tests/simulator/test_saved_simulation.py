"""A simulation that was saved goes on in another process, and in its own world alone."""

from __future__ import annotations

import math

import numpy as np
import pytest
from simulator_controls import hall_of

from rover_common.vehicle import ROVER
from rover_simulator.saved_simulation import SavedSimulation
from rover_simulator.simulation import RESUME_LEAP, Simulation

# One in reach of the arm at the start, and one elsewhere.
SAMPLES = ((100.0 + ROVER.arm_forward, 100.0), (110.0, 104.0))
FAST = {"steering_angle": "5", "throttle": "1", "brake": "0"}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "simulation.state"


def saved_drive(path, frames: int = 60) -> Simulation:
    world = hall_of(*SAMPLES)
    simulation = Simulation(world, 0, 2)
    saved = SavedSimulation(path, world, simulation)
    assert saved.resume() == []
    simulation.handle("data", FAST)
    for _ in range(frames):
        simulation.advance()
        saved.update()
    return simulation


def resumed(path, *samples) -> tuple[Simulation, list[str]]:
    world = hall_of(*(samples or SAMPLES))
    simulation = Simulation(world, 0, 2)
    return simulation, SavedSimulation(path, world, simulation).resume()


def test_it_goes_on_where_it_was_in_the_last_second_with_its_command(path):
    before = saved_drive(path)
    after, refusals = resumed(path)
    assert refusals == []
    moved = math.dist((before.pose.x, before.pose.y), (after.pose.x, after.pose.y))
    assert moved < before.distance / 2
    assert after.distance == pytest.approx(before.distance, abs=moved + 0.1)
    assert before.time < after.time <= before.time + RESUME_LEAP
    telemetry = after.telemetry()
    assert float(telemetry["throttle"]) == 1.0
    assert float(telemetry["speed"]) > 0.0
    start = after.pose
    after.advance()
    assert after.pose != start


def test_a_sample_that_is_gone_is_not_there_again(path):
    before = saved_drive(path, 1)
    world = hall_of(*SAMPLES)
    saved = SavedSimulation(path, world, before)
    before.handle("pickup", {})
    for _ in range(255):  # 10.2 s
        before.advance()
        saved.update()
    after, _ = resumed(path)
    assert after.samples_left == len(SAMPLES) - 1
    image = after.telemetry()["image"]
    fresh = Simulation(world, 0, 2)
    assert image != fresh.telemetry()["image"]  # nor does the camera see it


def test_a_pickup_in_progress_begins_anew_with_the_sample_where_it_lay(path):
    before = saved_drive(path, 1)
    world = hall_of(*SAMPLES)
    saved = SavedSimulation(path, world, before)
    before.handle("pickup", {})
    for _ in range(120):  # 4.8 s: it is lifted
        before.advance()
        saved.update()
    after, _ = resumed(path)
    assert np.allclose(after._arm.samples, SAMPLES)
    assert after.telemetry()["picking_up"] == "0"
    assert after.telemetry()["near_sample"] == "1"


def test_a_file_of_another_world_is_refused_and_the_simulation_begins_anew(path):
    saved_drive(path)
    after, refusals = resumed(path, (110.0, 100.0))
    assert len(refusals) >= 1
    assert "another world" in refusals[0]
    assert after.distance == 0.0


def test_a_torn_file_leaves_the_older_one(path):
    saved_drive(path)
    path.write_bytes(path.read_bytes()[:-1])
    after, (refusal,) = resumed(path)
    assert "torn" in refusal
    assert after.distance > 0.0
