"""`rover bench simulator`: the embedded simulator against recordings of the original."""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_bringup.command import run_command
from rover_bringup.data import data_folder
from rover_bringup.results import Result, summary
from rover_bringup.run import note
from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose, wrap_angle
from rover_common.scoring import load_truth
from rover_simulator.recording import RecordedFrame, read_recording
from rover_simulator.renderer import Renderer
from rover_simulator.simulation import Simulation
from rover_simulator.terrain import Terrain
from rover_simulator.vehicle import STEP, Controls, Slope, Vehicle
from rover_simulator.world import World
from rover_simulator.worldgen import generate_world

RUNS = ("udacity/test_dataset", "recordings/long", "recordings/medium", "recordings/arm")
WINDOW = 5.0  # [s]
COLLISION_TILT = math.radians(3.0)  # more than driving alone can tilt the body
EVERY = 25  # frames between two that are rendered
SKY_RED = (100, 190)  # red channel of the sky; bright ground lies above, walls below
SPEED_FRAMES = 200


def main(arguments: list[str]) -> int:
    """Returns the exit code."""
    parser = argparse.ArgumentParser(prog="rover bench simulator", description=__doc__)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    return run_command("bench simulator", lambda: _bench(as_json=options.json))


def _bench(as_json: bool) -> None:
    result: Result = {}
    data = data_folder()
    truth = data / "udacity" / "calibration_images" / "map_bw.png"
    if truth.exists():
        result |= motion_errors(data) | picture_agreement(data, truth)
    else:
        note(f"no recordings in {data}: only the speed is measured")
    result["frames_per_second"] = round(frames_per_second(), 1)
    print(json.dumps(result) if as_json else summary(result))


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
    vehicle.roll_on(frames[0].speed, _between(frames[0], frames[0]))
    for frame, following in pairwise(frames):
        controls = _between(frame, following)
        steps = round((following.time - frames[0].time) / STEP) - round(
            (frame.time - frames[0].time) / STEP
        )
        for _ in range(steps):
            vehicle.step(controls, Slope())
    last = frames[-1]
    offset = (vehicle.pose.x - last.pose.x, vehicle.pose.y - last.pose.y)
    return (
        abs(vehicle.speed - last.speed),
        abs(wrap_angle(vehicle.pose.yaw - last.pose.yaw)),
        math.hypot(*offset),
    )


def _between(frame: RecordedFrame, following: RecordedFrame) -> Controls:
    """Keys ramp their inputs, so that between two samples the input is about their mean."""
    return Controls(
        (frame.steering_angle + following.steering_angle) / 2,
        (frame.throttle + following.throttle) / 2,
        (frame.brake + following.brake) / 2,
    )


def picture_agreement(data: Path, truth: Path) -> Result:
    """How well rendered pictures cover recorded ones: ground, sky, and their mean colours."""
    navigable = load_truth(truth)
    world = World("original", navigable, np.empty((0, 2)), Pose(99.67, 85.589, 0.0))
    renderer = Renderer(world, Terrain.of(navigable))
    ground, sky = np.zeros(2), np.zeros(2)
    for run in RUNS:
        for frame in read_recording(data / run).frames[::EVERY]:
            if max(abs(frame.pose.pitch), abs(frame.pose.roll)) > COLLISION_TILT:
                continue
            picture = cv2.imread(str(frame.image_path))
            assert picture is not None, frame.image_path
            recorded = np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)
            rendered = renderer.render(frame.pose).image
            ground += _overlap(_ground(recorded), _ground(rendered))
            sky += _overlap(_sky(recorded), _sky(rendered))
    return {
        "ground_iou": round(float(ground[0] / ground[1]), 4),
        "sky_iou": round(float(sky[0] / sky[1]), 4),
    }


def _ground(image: NDArray[np.uint8]) -> NDArray[np.bool_]:
    bright = image[..., 0] > 150
    bright[: ROVER_CAMERA.height // 2 - 8] = False
    return bright


def _sky(image: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Grey, smooth pixels in the upper half."""
    red = image[..., 0]
    grey = (red > SKY_RED[0]) & (red < SKY_RED[1])
    grey[ROVER_CAMERA.height // 2 :] = False
    closed = cv2.morphologyEx(grey.astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    return np.asarray(closed > 0)


def _overlap(a: NDArray[np.bool_], b: NDArray[np.bool_]) -> NDArray[np.int64]:
    return np.array([np.count_nonzero(a & b), np.count_nonzero(a | b)])


def frames_per_second() -> float:
    """Physics, camera and JPEG on this thread."""
    simulation = Simulation(generate_world(3), 3, 2)
    simulation.handle("data", {"steering_angle": "3", "throttle": "0.3", "brake": "0"})
    start = time.perf_counter()
    for _ in range(SPEED_FRAMES):
        simulation.advance()
        simulation.telemetry()
    return SPEED_FRAMES / (time.perf_counter() - start)
