"""The embedded simulator against recordings of the original."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from rover_common.geometry import wrap_angle
from rover_common.ground_truth import load_truth
from rover_simulator.recordings.recording import RecordedFrame, read_recording
from rover_simulator.simulation import Simulation
from rover_simulator.vehicle.ground import FLAT
from rover_simulator.vehicle.vehicle import Vehicle
from rover_simulator.world.generator import generate_world
from rover_tools.benchmarks.pictures import COLLISION_TILT, RUNS, picture_agreement
from rover_tools.benchmarks.recorded_commands import between, commands
from rover_tools.benchmarks.tilt import table, tilt_agreement
from rover_tools.benchmarks.wire_speed import wire_speed
from rover_tools.evaluation.recordings import data_folder
from rover_tools.evaluation.results import Result, summary
from rover_tools.output import note, print_result

WINDOW = 5.0  # [s]
SPEED_FRAMES = 200
SEED = 3  # of the world that speed and memory are measured in
STEERING_DEG, THROTTLE = "3", "0.3"  # of the drive
# A process of its own: what this one has loaded and measured before does not count.
FRESH = "from rover_tools.benchmarks.simulator import fresh_simulation as fresh; fresh()"


def bench(picture: Path | None, as_json: bool) -> None:
    """Compare with recordings where there are some, measure speed and memory, and print."""
    result: Result = {}
    data = data_folder()
    truth = data / "udacity" / "calibration_images" / "map_bw.png"
    if truth.exists():
        result |= motion_errors(data) | tilt_agreement(data, RUNS, truth)
        result |= picture_agreement(data, load_truth(truth), picture)
    else:
        note(f"no recordings in {data}: only speed and memory are measured")
    fresh = subprocess.run([sys.executable, "-c", FRESH], check=True, capture_output=True)
    result |= json.loads(fresh.stdout) | wire_speed(SEED)
    tilts = f"\n{table(result)}" if "tilt_floor" in result else ""
    print_result(result, as_json, summary(result) + tilts)


def motion_errors(data: Path) -> Result:
    """Median errors at the end of windows driven with the recorded commands."""
    errors = [
        window_error(frames)
        for run in RUNS
        for frames in windows(read_recording(data / run).frames)
    ]
    speed, yaw, position = np.median(np.array(errors), axis=0)
    return {
        "windows": len(errors),
        "speed_error": round(float(speed), 4),
        "yaw_error_deg": round(math.degrees(float(yaw)), 3),
        "position_error": round(float(position), 4),
    }


def windows(frames: tuple[RecordedFrame, ...]) -> Iterator[list[RecordedFrame]]:
    """Stretches of five seconds without a sign of a collision."""
    window: list[RecordedFrame] = []
    for frame in frames:
        if max(abs(frame.pose.pitch), abs(frame.pose.roll)) > COLLISION_TILT:
            window = []
            continue
        window.append(frame)
        if frame.time - window[0].time >= WINDOW:
            yield window
            window = []


def window_error(frames: list[RecordedFrame]) -> tuple[float, float, float]:
    """Errors of speed [m/s], yaw [rad] and position [m] at the window's end."""
    vehicle = Vehicle(frames[0].pose)
    vehicle.roll_on(frames[0].speed, between(frames[0], frames[0]))
    for _, controls, steps in commands(frames):
        for _ in range(steps):
            vehicle.step(controls, FLAT)
    last = frames[-1]
    offset = (vehicle.pose.x - last.pose.x, vehicle.pose.y - last.pose.y)
    return (
        abs(vehicle.speed - last.speed),
        abs(wrap_angle(vehicle.pose.yaw - last.pose.yaw)),
        math.hypot(*offset),
    )


def fresh_simulation() -> None:
    """Print the cost of one simulation in this process, which should have done nothing before.

    `world_seconds` is the wall time of its world, terrain and renderer, `frames_per_second` the
    rate of physics, camera, JPEG and telemetry on this thread, `memory_mb` the largest memory of
    the whole process [MB of 2^20], libraries included.
    """
    start = time.perf_counter()
    simulation = Simulation(generate_world(SEED), SEED, 2)
    ready = time.perf_counter()
    command = {"steering_angle": STEERING_DEG, "throttle": THROTTLE, "brake": "0"}
    simulation.handle("data", command)
    for _ in range(SPEED_FRAMES):
        simulation.advance()
        simulation.telemetry()
    end = time.perf_counter()
    status = Path("/proc/self/status").read_text()
    peak = next(line for line in status.splitlines() if line.startswith("VmHWM:"))
    cost = {
        "frames_per_second": round(SPEED_FRAMES / (end - ready), 1),
        "world_seconds": round(ready - start, 2),
        "memory_mb": round(int(peak.split()[1]) / 1024, 1),
    }
    print(json.dumps(cost))
