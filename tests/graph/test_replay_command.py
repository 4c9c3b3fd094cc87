"""`rover replay` as a user calls it: three processes, a result folder, one JSON object."""

import json
import re
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np

from rover_simulator.recordings.recorder import record_drive

ROOT = Path(__file__).resolve().parents[2]
KEYS = {
    "frames", "frames_refused", "frames_skipped", "frames_per_second", "latency_ms_p50",
    "latency_ms_p99",
    "percent_mapped", "fidelity", "f1", "rocks_located", "rocks_missed", "rocks_false",
}  # fmt: skip


def rover(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "rover_tools.cli.main", *arguments],
        capture_output=True,
        text=True,
        timeout=120,
    )


def test_replay_as_the_readme_has_it(tmp_path, monkeypatch):
    monkeypatch.chdir(ROOT)
    (example,) = re.findall(r"^ +\./rover (replay [^#\n]*)", (ROOT / "README.md").read_text(), re.M)
    out = tmp_path / "result"
    done = rover(
        *example.split(), "--samples", "docs/examples/samples.csv", "--out", str(out), "--json"
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    (line,) = done.stdout.splitlines()
    result = json.loads(line)
    assert set(result) >= KEYS
    counts = [result[key] for key in ("frames", "frames_refused", "frames_skipped")]
    assert counts == [200, 0, 0]
    assert result["fidelity"] > 90
    assert result["percent_mapped"] > 2
    assert json.loads((out / "result.json").read_text()) == result
    assert cv2.imread(str(out / "map.png")) is not None
    pgm = cv2.imread(str(out / "worldmap.pgm"), cv2.IMREAD_UNCHANGED)
    assert pgm.shape == (200, 200)
    assert np.count_nonzero(pgm == 254) > 20
    assert (out / "worldmap.yaml").exists()
    logs = {path.name: path.read_text() for path in (out / "log").iterdir()}
    assert set(logs) == {"bridge_node.log", "perception_node.log", "decision_node.log"}
    assert "listening on" in logs["bridge_node.log"]


def test_replay_of_nothing_is_one_sentence(tmp_path):
    done = rover("replay", str(tmp_path))
    assert done.returncode == 1
    assert done.stderr.startswith("rover replay: ")
    assert "robot_log.csv" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_run_of_which_the_bridge_refuses_every_frame_is_one_sentence(tmp_path):
    drive = record_drive(tmp_path / "drive", seed=1, frames=5)
    log = drive.folder / "robot_log.csv"
    head, *rows = log.read_text().splitlines()
    column = head.split(";").index("X_Position")
    cells = [row.split(";") for row in rows]
    for row in cells:
        row[column] = "5000"
    log.write_text("\n".join([head, *(";".join(row) for row in cells)]))
    done = rover("replay", str(drive.folder), "--out", str(tmp_path / "result"))
    assert done.returncode == 1
    last = done.stderr.splitlines()[-1]
    assert last.startswith("rover replay: none of 5 frames could be used: out of range (5); ")
    assert "Traceback" not in done.stderr


def test_an_unknown_command_is_told():
    done = rover("dance")
    assert done.returncode == 2
    assert "no command 'dance'" in done.stderr


def test_a_run_that_is_ended_leaves_no_process(tmp_path):
    drive = record_drive(tmp_path / "drive", seed=1, frames=60)
    out = tmp_path / "result"
    command = [sys.executable, "-m", "rover_tools.cli.main", "replay", str(drive.folder)]
    run = subprocess.Popen([*command, "--out", str(out)], stderr=subprocess.PIPE, text=True)
    assert run.stderr is not None
    assert run.stderr.readline().startswith("starting the graph")
    children = node_processes(run.pid)
    assert len(children) == 3
    run.terminate()
    _, errors = run.communicate(timeout=30)
    assert run.returncode == 130
    assert errors.endswith("rover replay: stopped\n")
    assert not [pid for pid in children if alive(pid)]


def node_processes(parent: int) -> list[int]:
    """The processes that a process has started."""
    return [int(pid) for task in Path(f"/proc/{parent}/task").iterdir()
            for pid in (task / "children").read_text().split()]  # fmt: skip


def alive(pid: int) -> bool:
    return Path(f"/proc/{pid}").exists()
