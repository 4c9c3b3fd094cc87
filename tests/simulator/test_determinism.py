"""The same world, seed and commands give the same telemetry, byte for byte, images too."""

from __future__ import annotations

import base64
import hashlib
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from raw_server import HANDSHAKE, RawServer

from rover_common.geometry import Pose
from rover_simulator.simulation import Simulation
from rover_simulator.world.world import World

SEED = 11
FRAME_STEPS = 5  # 0.1 s, so that the arm's ten seconds are few frames
FPS = 10.0
END_SECONDS = 20
Command = tuple[str, dict[str, str]]


def drive(steering: float, throttle: float, brake: float = 0.0) -> Command:
    values = {"steering_angle": steering, "throttle": throttle, "brake": brake}
    return "data", {key: f"{value:.4f}" for key, value in values.items()}


# One for each frame: a pickup, a fixed turn, a drive in bends into the wall, and back.
SCRIPT: list[Command] = [
    ("manual", {}),
    ("pickup", {}),
    *[drive(index % 7 - 3, 0.3) for index in range(101)],
    ("fixed_turn", {"angle": "-50", "time": "1.5"}),
    *[("manual", {})] * 15,
    *[drive(8 * np.sin(index / 7), 0.9) for index in range(60)],
    *[drive(0, 0, 5)] * 3,
    *[drive(15, 0)] * 10,
]


@pytest.fixture(scope="module")
def world() -> World:
    navigable = np.zeros((200, 200), bool)
    navigable[90:111, 90:111] = True
    samples = np.array([[100.9, 100.1], [103.0, 104.0]])
    return World("small hall", navigable, samples, Pose(100, 100, 0.1))


def in_core(world: World) -> list[dict[str, str]]:
    simulation = Simulation(world, SEED, FRAME_STEPS)
    telemetries = [simulation.telemetry()]
    for event, data in SCRIPT:
        assert simulation.handle(event, data)
        simulation.advance()
        telemetries.append(simulation.telemetry())
    return telemetries


def over_the_wire(folder: Path) -> list[dict[str, str]]:
    """Of a process of its own, as a scripted server receives them."""
    server = RawServer()
    command = [
        sys.executable, "-m", "rover_simulator.main", "--port", str(server.port),
        "--world", folder, "--seed", str(SEED), "--rate", "fast", "--fps", str(FPS),
        "--dead-man", "0",  # the script is silent for longer
    ]  # fmt: skip
    process = subprocess.Popen(command)
    try:
        telemetries = received(server)
        process.terminate()
        assert process.wait(END_SECONDS) == 0
    finally:
        server.close()
        if process.poll() is None:
            process.kill()
            process.wait()
    return telemetries


def received(server: RawServer) -> list[dict[str, str]]:
    wire = server.accept(timeout=60)
    first = wire.telemetry()
    wire.send(HANDSHAKE)
    assert wire.telemetry() == first
    wire.emit("manual", {})  # the first two have one answer
    telemetries = [first]
    for event, data in SCRIPT:
        wire.emit(event, data)
        telemetries.append(wire.telemetry())
    return telemetries


def image_hashes(telemetries: list[dict[str, Any]]) -> list[str]:
    images = (base64.b64decode(telemetry["image"], validate=True) for telemetry in telemetries)
    return [hashlib.sha256(image).hexdigest() for image in images]


def test_the_script_does_something(core):
    assert len(set(image_hashes(core))) > 80
    assert [core[0]["sample_count"], core[-1]["sample_count"]] == ["2", "1"]
    assert len({telemetry["yaw"] for telemetry in core}) > 50


@pytest.fixture(scope="module")
def core(world) -> list[dict[str, str]]:
    return in_core(world)


def test_two_runs_of_the_core_are_the_same(world, core):
    again = in_core(world)
    assert image_hashes(again) == image_hashes(core)
    assert again == core


def test_a_run_in_another_process_over_the_wire_is_the_same(world, core, tmp_path):
    world.save(tmp_path)
    telemetries = over_the_wire(tmp_path)
    assert image_hashes(telemetries) == image_hashes(core)
    assert telemetries == core
