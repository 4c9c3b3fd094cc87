"""A real peer: a server on the libraries that the Unity simulator's servers are written with.

Those libraries exclude the ones of this project, so it runs with a Python environment of its own.
"""

from __future__ import annotations

import base64
import contextlib
import fcntl
import hashlib
import json
import os
import socket
import subprocess
import sys
import venv
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PEER = Path(__file__).parent / "peer"
REQUIREMENTS = PEER / "requirements.txt"
ENVIRONMENT = ROOT / ".venv-peer"

TELEMETRIES = 150
RUN_SECONDS = 120  # [s] of wall time; it takes a few
INSTALL_SECONDS = 120
END_SECONDS = 10
FRAME = 0.04  # [s]
KEYS = [
    "steering_angle", "throttle", "brake", "speed", "position", "pitch", "yaw", "roll",
    "near_sample", "picking_up", "sample_count", "samples_x", "samples_y", "image", "sim_time",
]  # fmt: skip


@pytest.fixture(scope="session")
def peer_python() -> str:
    """The peer's Python; made once, and again when its requirements change."""
    python = ENVIRONMENT / "bin" / "python"
    stamp = ENVIRONMENT / ".stamp"
    wanted = hashlib.sha256(REQUIREMENTS.read_bytes() + str(ENVIRONMENT).encode()).hexdigest()
    with (ROOT / ".venv-peer.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # several test processes may want it at once
        if not (stamp.exists() and stamp.read_text() == wanted):
            _install(python)
            stamp.write_text(wanted)
    return str(python)


def _install(python: Path) -> None:
    """Skips the test, with the reason, where it cannot be done."""
    try:
        venv.create(ENVIRONMENT, clear=True)
    except OSError as error:
        pytest.skip(f"no environment for the peer: {error}")
    command = [sys.executable, "-m", "pip", "--python", python]  # a pip of its own takes long
    command += ["install", "--no-input", "--no-deps", "--quiet"]
    command += ["--disable-pip-version-check", "--retries", "1", "-r", REQUIREMENTS]
    try:
        done = subprocess.run(
            command, env=own_environment(), capture_output=True, text=True, timeout=INSTALL_SECONDS
        )
    except subprocess.TimeoutExpired:
        pytest.skip(f"the peer's libraries were not installed within {INSTALL_SECONDS} s")
    if done.returncode != 0:
        errors = [line for line in done.stderr.splitlines() if "ERROR" in line]
        reason = errors[-1] if errors else f"pip ended with {done.returncode}"
        pytest.skip(f"the peer's libraries cannot be installed: {reason}")


def own_environment() -> dict[str, str]:
    """Without what would let the peer find this project's libraries instead of its own."""
    return {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}


@contextlib.contextmanager
def ended_after(process: subprocess.Popen[str]) -> Iterator[subprocess.Popen[str]]:
    """A process that is no more when the block is over."""
    try:
        yield process
    finally:
        if process.poll() is None:
            process.terminate()
            try:
                process.wait(END_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
        process.communicate()


def recorded_events(peer_python: str, folder: Path, rate: str) -> list[tuple[str, object]]:
    """The events that the peer recorded in a run with `rover sim`."""
    record = folder / "record.jsonl"
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port, descriptor = listener.getsockname()[1], listener.fileno()
        peer = subprocess.Popen(
            [peer_python, PEER / "server.py", str(descriptor), str(TELEMETRIES), record],
            pass_fds=[descriptor], env=own_environment(), stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
    simulator = [
        sys.executable, "-m", "rover_simulator.main",
        "--port", str(port), "--seed", "3", "--rate", rate,
    ]  # fmt: skip
    with ended_after(peer), ended_after(subprocess.Popen(simulator, text=True)) as running:
        _, errors = peer.communicate(timeout=RUN_SECONDS)
        assert peer.returncode == 0, errors
        assert running.poll() is None  # it goes on trying to connect
        running.terminate()
        assert running.wait(END_SECONDS) == 0
    return [tuple(json.loads(line)) for line in record.read_text().splitlines()]


@pytest.fixture(scope="module")
def fast_record(peer_python, tmp_path_factory) -> list[tuple[str, object]]:
    return recorded_events(peer_python, tmp_path_factory.mktemp("fast"), "fast")


def telemetries(record) -> list[dict[str, str]]:
    return [data for name, data in record if name == "telemetry"]


def test_every_value_is_a_string_and_the_keys_are_in_order(fast_record):
    received = telemetries(fast_record)
    assert len(received) == TELEMETRIES
    assert all(list(telemetry) == KEYS for telemetry in received)
    assert all(isinstance(value, str) for telemetry in received for value in telemetry.values())


def test_fast_each_command_is_answered_once_and_by_the_next_frame(fast_record):
    received = telemetries(fast_record)
    commands = [steering for name, steering in fast_record if name == "data"]
    assert len(commands) == TELEMETRIES
    # Two telemetries come unasked, of one frame; the command that comes unasked is one of the two
    # that the next frame answers together.
    steering = [telemetry["steering_angle"] for telemetry in received]
    assert steering == ["0.0000"] * 2 + commands[1:-1]
    times = [round(float(telemetry["sim_time"]) / FRAME) for telemetry in received]
    assert times == [times[0], *range(times[0], times[0] + TELEMETRIES - 1)]


def test_fast_the_images_are_jpegs_of_the_cameras_size(fast_record):
    images = [base64.b64decode(t["image"], validate=True) for t in telemetries(fast_record)]
    for image in images:
        assert (image[:2], image[-2:]) == (b"\xff\xd8", b"\xff\xd9")
        decoded = cv2.imdecode(np.frombuffer(image, np.uint8), cv2.IMREAD_COLOR)
        assert decoded.shape == (160, 320, 3)
    assert len(set(images)) > TELEMETRIES / 2  # it moves


def test_timed_each_command_is_answered_once_and_by_a_later_frame(peer_python, tmp_path):
    record = recorded_events(peer_python, tmp_path, "4")
    received = telemetries(record)
    commands = [steering for name, steering in record if name == "data"]
    assert len(received) == len(commands) == TELEMETRIES
    times = [round(float(telemetry["sim_time"]) / FRAME) for telemetry in received]
    assert times == sorted(times)
    pending = 3  # two telemetries and one command, all unasked
    assert all(later > earlier for earlier, later in zip(times, times[pending:], strict=False))


def test_a_program_of_the_originals_time_drives_as_it_is(peer_python, tmp_path):
    """Perception and decision step, answers as text, pictures for the screen, on old libraries."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = str(listener.getsockname()[1])
    program = subprocess.Popen(
        [peer_python, PEER / "drive_rover.py", port],
        env=own_environment(), stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    simulator = [
        sys.executable, "-m", "rover_simulator.main", "--port", port, "--seed", "1",
        "--size", "0.4", "--rate", "fast", "--fps", "12.5", "--time-limit", "41", "--progress",
        "--save-insets", str(tmp_path),
    ]  # fmt: skip
    with ended_after(program):
        done = subprocess.run(simulator, capture_output=True, text=True, timeout=RUN_SECONDS)
        assert program.poll() is None, program.stderr
    assert done.returncode == 0, done.stderr
    last = json.loads(done.stdout.splitlines()[-1])
    assert last["time"] > 40.0  # [s] no telemetry was lost
    assert last["distance"] > 20.0  # [m]
    assert list(tmp_path.glob("*"))
