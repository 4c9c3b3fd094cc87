"""Driving by hand: what the keys mean, the terminal, and a drive in the simulator."""

from __future__ import annotations

import json
import os
import pty
import subprocess
import sys
import termios
import threading
from pathlib import Path

import pytest
from waiting import holds

from rover_recorder.reader import open_recording
from rover_tools.cli.main import main
from rover_tools.teleop.keys import SPEEDS, TURN_RATE, Key, KeyDriver, keys_of
from rover_tools.teleop.terminal import Terminal

WAIT = 60.0  # [s] a busy machine is slow


@pytest.mark.parametrize(
    ("typed", "keys"),
    [
        (b"wW", [Key.FASTER, Key.FASTER]),
        (b"\x1b[A\x1b[B\x1b[D\x1b[C", [Key.FASTER, Key.SLOWER, Key.LEFT, Key.RIGHT]),
        (b"\x1bOA", [Key.FASTER]),
        (b"a d", [Key.LEFT, Key.BRAKE, Key.RIGHT]),
        (b"q\x04", [Key.END, Key.END]),
        (b"zx\x1b[15~\x1b[1;5A\xff", []),  # others, a function key, an arrow with control
    ],
)
def test_keys_and_arrows(typed, keys):
    assert list(keys_of(typed)) == keys


def velocity(*keys: Key) -> tuple[float, float]:
    driver = KeyDriver()
    for key in keys:
        driver.press(key)
    return driver.velocity.linear, driver.velocity.angular


def test_each_press_is_a_step_within_the_limits():
    assert velocity(Key.FASTER) == (0.5, 0.0)
    assert velocity(*[Key.FASTER] * 20)[0] == SPEEDS[1]
    assert velocity(*[Key.SLOWER] * 20)[0] == SPEEDS[0]
    assert velocity(Key.LEFT) == (0.0, pytest.approx(TURN_RATE / 3))
    assert velocity(*[Key.RIGHT] * 9) == (0.0, pytest.approx(-TURN_RATE))


def test_a_curve_is_as_tight_at_every_speed_and_left_is_left():
    linear, angular = velocity(Key.FASTER, Key.LEFT, Key.LEFT, Key.LEFT)
    assert angular / linear == pytest.approx(0.35)
    linear, angular = velocity(*[Key.FASTER] * 4, Key.LEFT, Key.LEFT, Key.LEFT)
    assert angular / linear == pytest.approx(0.35)
    assert velocity(Key.SLOWER, Key.LEFT)[1] > 0.0


def test_the_brake_takes_speed_and_turn_away():
    assert velocity(Key.FASTER, Key.LEFT, Key.BRAKE) == (0.0, 0.0)


def test_a_terminal_is_as_it_was_afterwards():
    ours, theirs = pty.openpty()
    try:
        before = termios.tcgetattr(theirs)
        with Terminal(theirs) as terminal:
            assert terminal.read(0.0) == b""
            os.write(ours, b"w")  # without a line's end
            assert terminal.read(WAIT) == b"w"
        assert termios.tcgetattr(theirs) == before
    finally:
        os.close(ours)
        os.close(theirs)


def test_without_a_terminal_it_says_so(capsys, monkeypatch):
    with Path("/dev/null").open() as nothing:
        monkeypatch.setattr(sys, "stdin", nothing)
        assert main(["drive"]) == 1
    assert capsys.readouterr().err == (
        "rover drive: the keys come from a terminal, and the input is none\n"
    )


def test_a_drive_by_keys_moves_the_rover_and_leaves_a_recording(tmp_path):
    ours, theirs = pty.openpty()
    command = ["drive", "--seed", "1", "--size", "0.4", "--fps", "12.5", "--no-dashboard"]
    said = bytearray()
    with subprocess.Popen(
        [sys.executable, "-m", "rover_tools.cli.main", *command, "--out", str(tmp_path)],
        stdin=theirs, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    ) as process:  # fmt: skip

        def listen() -> None:
            while part := os.read(process.stderr.fileno(), 4096):
                said.extend(part)

        listener = threading.Thread(target=listen)
        listener.start()

        def wait_for(text: bytes) -> None:
            assert holds(lambda: text in said or process.poll() is not None, WAIT), said.decode()
            assert text in said, said.decode()
            said.clear()

        wait_for(b"driver: manual")
        os.write(ours, b"ww")
        wait_for(b"0.9")  # [m/s]
        os.write(ours, b" ")
        wait_for(b"0.00 m/s of  0.0")
        os.write(ours, b"q")
        assert process.wait(WAIT) == 0, said.decode()
        listener.join()
    os.close(ours)
    os.close(theirs)
    counts = open_recording(tmp_path).counts
    assert counts["/cmd_vel_teleop"] > 10
    assert counts["/odom"] > 10
    result = json.loads((tmp_path / "result.json").read_text())
    assert result["distance"] > 0.3  # [m]
    assert result["percent_mapped"] > 0.0
    assert (tmp_path / "map.png").is_file()
