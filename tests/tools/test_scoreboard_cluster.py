"""The scoreboard as a user calls it: real missions on a real cluster of processes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from rover_tools.scoreboard.mission_run import ROW_KEYS

# Small canyons and short missions
TINY = ("--size", "0.2", "--fps", "12.5", "--time-limit", "1")
DEADLINE = 100.0  # [s]

ONE_OF_TWO_RAISES = """
from rover_tools.scoreboard.cluster import local_cluster, run_all
from rover_tools.scoreboard.job import Job


def run(job):
    if job.seed == 1:
        raise ValueError("too steep")
    return job.name


if __name__ == "__main__":
    jobs = [Job("tour", seed, None, 0.2, 12.5, 0.5) for seed in (1, 2)]
    with local_cluster(1) as client:
        for job, outcome in run_all(client, jobs, run):
            print(job.seed, repr(outcome))
"""


def start(*arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "rover_tools.cli.main", "scoreboard", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def wait_for_a_mission(run: subprocess.Popen[str]) -> None:
    """Until it says that one is over; a run that never does is ended at the deadline."""
    assert run.stderr is not None
    deadline = threading.Timer(DEADLINE, os.killpg, (run.pid, signal.SIGKILL))
    deadline.start()
    try:
        assert any(" tour: " in line for line in run.stderr)
    finally:
        deadline.cancel()
        deadline.join()


def test_ctrl_c_and_on_again(tmp_path):
    missions = tmp_path / "missions"
    run = start("--worlds", "1-2", "--workers", "1", *TINY, "--out", str(tmp_path))
    wait_for_a_mission(run)
    os.killpg(run.pid, signal.SIGINT)  # as a terminal sends it: to the workers as well
    _, said = run.communicate(timeout=DEADLINE)
    assert run.returncode == 130, said
    assert f"to continue, run it again with --out {tmp_path}" in said
    assert "Traceback" not in said
    completed = {path: path.stat().st_mtime_ns for path in missions.glob("*.json")}
    assert len(completed) == 1

    run = start("--worlds", "1-2", "--workers", "1", *TINY, "--out", str(tmp_path), "--json")
    output, said = run.communicate(timeout=DEADLINE)
    assert run.returncode == 0, said
    rows = json.loads(output)
    assert [(row["world"], row["strategy"]) for row in rows] == [
        ("seed-1", "tour"), ("seed-2", "tour"),
    ]  # fmt: skip
    for row in rows:
        assert tuple(row) == ROW_KEYS
        assert row["time"] == 1.0
        assert row["percent_mapped"] > 0
        assert row["oracle_time"] > 10
    assert all(path.stat().st_mtime_ns == when for path, when in completed.items())
    for row in rows:
        name = f"generated-{row['seed']}-tour"
        assert ElementTree.parse(missions / f"{name}.svg").getroot().tag.endswith("svg")
        assert f"seed-{row['seed']}, tour" in (missions / f"{name}.html").read_text()
        assert (missions / f"{name}.csv").read_text().count("\n") >= 2  # a heading, and a point
    assert "seed-2" in (tmp_path / "report.html").read_text()


def test_a_mission_that_raises_on_a_worker_does_not_stop_the_others(tmp_path: Path):
    script = tmp_path / "script.py"
    script.write_text(ONE_OF_TWO_RAISES)
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, timeout=DEADLINE
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(done.stdout.splitlines()) == ["1 ValueError('too steep')", "2 'generated-2-tour'"]
