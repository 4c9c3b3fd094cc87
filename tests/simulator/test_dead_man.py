"""A rover that nobody commands brakes, unless it is to behave as the original."""

from __future__ import annotations

import math

import pytest
from simulator_controls import hall_of

from rover_common.geometry import Pose
from rover_simulator.simulation import Simulation
from rover_simulator.vehicle.dead_man import STOP, DeadMan
from rover_simulator.vehicle.vehicle import Controls

DRIVE = {"steering_angle": "0", "throttle": "1", "brake": "0"}
LIMIT = 0.5  # [s]
FRAME = 0.04  # [s]
FORWARD = Controls(throttle=1.0)


def few_rows(_: Pose) -> int:
    """Where no image is needed."""
    return 152


def simulation(dead_man: float) -> Simulation:
    made = Simulation(hall_of(), 0, 2, dead_man)
    made.crop_images(few_rows)
    return made


def frames_until_the_brake(rover: Simulation) -> int:
    for frame in range(1, 100):
        rover.advance()
        if float(rover.telemetry()["brake"]) > 0.0:
            return frame
    pytest.fail("it never brakes")


def drive(rover: Simulation, frames: int) -> None:
    for _ in range(frames):
        assert rover.handle("data", DRIVE)
        rover.advance()


def test_a_rover_that_drives_without_commands_brakes_and_stands():
    rover = simulation(LIMIT)
    drive(rover, 50)
    assert rover.dead_man_stops == 0
    rover.handle("data", DRIVE)
    before = rover.time
    frames_until_the_brake(rover)
    assert LIMIT - 2 * FRAME <= rover.time - FRAME - before <= LIMIT - FRAME
    assert rover.dead_man_stops == 1
    for _ in range(50):
        rover.advance()
    telemetry = rover.telemetry()
    assert (telemetry["speed"], telemetry["throttle"]) == ("0.0000", "0.0000")
    assert rover.dead_man_stops == 1


def test_the_longest_time_without_a_command_is_that_before_the_brake():
    rover = simulation(LIMIT)
    drive(rover, 50)
    assert rover.longest_unbraked == pytest.approx(FRAME)
    for _ in range(4):  # without a command
        rover.advance()
    assert rover.longest_unbraked == pytest.approx(5 * FRAME)
    drive(rover, 1)
    frames_until_the_brake(rover)
    assert LIMIT - 2 * FRAME <= rover.longest_unbraked <= LIMIT - FRAME
    longest = rover.longest_unbraked
    for _ in range(50):
        rover.advance()
    assert rover.longest_unbraked == longest


def test_the_next_command_ends_it():
    rover = simulation(LIMIT)
    drive(rover, 5)
    frames_until_the_brake(rover)
    drive(rover, 20)
    assert float(rover.telemetry()["speed"]) > 0.5
    assert rover.dead_man_stops == 1


@pytest.mark.parametrize(
    ("event", "data"),
    [("manual", {}), ("data", DRIVE | {"brake": "x"}), ("data", {}), ("get_samples", {})],
)
def test_what_commands_nothing_keeps_no_rover_driving(event, data):
    rover = simulation(LIMIT)
    drive(rover, 5)
    for _ in range(20):
        rover.handle(event, data)
        rover.advance()
    assert rover.dead_man_stops == 1


def test_without_it_the_rover_drives_on_as_the_original_does():
    rover = simulation(math.inf)
    drive(rover, 5)
    for _ in range(100):
        rover.advance()
    assert float(rover.telemetry()["speed"]) > 3.0
    assert rover.dead_man_stops == 0


def test_the_same_commands_give_the_same_telemetry_with_it_and_without():
    with_it, without = simulation(LIMIT), simulation(math.inf)
    for index in range(60):
        for rover in (with_it, without):
            rover.handle("data", DRIVE | {"steering_angle": str(index % 7 - 3)})
            rover.advance()
        assert with_it.telemetry() == without.telemetry()


@pytest.mark.parametrize("frame", [0.02, 0.04, 0.08, 0.1, 0.16])
def test_it_brakes_in_time_whenever_in_a_frame_the_command_came(frame):
    dead_man = DeadMan(LIMIT)
    dead_man.hear(1.0)
    began = [1.0 + frame * count for count in range(100)]
    brakes = next(t for t in began if dead_man.controls(t, frame, FORWARD, True) == STOP)
    came = 1.0 - frame  # at the earliest, by the clock at which frames begin
    assert LIMIT - frame - 1e-9 < brakes - came <= LIMIT + 1e-9


def test_after_a_reset_it_brakes_as_before():
    rover = simulation(LIMIT)
    rover.handle("data", DRIVE)
    frames = frames_until_the_brake(rover)
    rover.reset()
    assert rover.dead_man_stops == 0
    rover.handle("data", DRIVE)
    assert frames_until_the_brake(rover) == frames


@pytest.mark.parametrize(
    ("held", "moving", "brakes"),
    [
        (FORWARD, False, True),
        (Controls(steering=0.1), False, True),  # turns in place
        (Controls(), True, True),  # rolls
        (Controls(brake=1.0), True, True),
        (Controls(), False, False),
        (Controls(brake=1.0, throttle=1.0), False, False),
    ],
)
def test_it_stops_what_moves_or_would(held, moving, brakes):
    dead_man = DeadMan(LIMIT)
    dead_man.hear(1.0)
    expected = STOP if brakes else held
    assert dead_man.controls(1.0 + LIMIT - FRAME / 2, FRAME, held, moving) == expected
    assert dead_man.stops == brakes


def test_frames_longer_than_its_limit_do_not_stop_a_rover_that_is_answered():
    dead_man = DeadMan(LIMIT)
    for second in range(5):
        dead_man.hear(float(second))
        assert dead_man.controls(float(second), 1.0, FORWARD, True) == FORWARD
    assert dead_man.stops == 0
    assert dead_man.controls(5.0, 1.0, FORWARD, True) == STOP


def test_before_the_first_command_nothing_is_expected():
    assert DeadMan(LIMIT).controls(100.0, FRAME, FORWARD, True) == FORWARD
