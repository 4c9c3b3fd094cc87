"""A mission records by default, and its recording gives the same map again, cell for cell."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from readme_tables import ROOT, table
from rosbags.rosbag2 import Reader

from rover_common import topics
from rover_recorder import bag
from rover_recorder.reader import open_recording
from rover_tools.cli.main import main

SECONDS = 5  # of simulated time
FPS = 12.5
NODES = {"bridge", "perception", "decision"}  # as the table of topics names their publishers


def rover(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "rover_tools.cli.main", *arguments],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip


@pytest.fixture(scope="module")
def mission(tmp_path_factory) -> Path:
    """The result folder of a mission that ran out of time."""
    folder = tmp_path_factory.mktemp("mission")
    done = rover(
        "mission", "--size", "0.2", "--seed", "11", "--time-limit", str(SECONDS),
        "--fps", str(FPS), "--no-dashboard", "--out", str(folder), "--json",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return folder


def test_a_mission_records_every_topic_of_every_frame(mission):
    folder = mission / "recording"
    recording = open_recording(mission)
    assert not recording.salvaged
    rows = table(ROOT / "rover_common" / "README.md", "Topics")
    names = {row["topic"] for row in rows if row["publisher"] in NODES}
    pictures = {topics.VISION_IMAGE, topics.BIRDSEYE_IMAGE}
    written = {f"/{name}" for name in names - pictures - {topics.IMAGE, topics.NAV_POLAR}}
    written |= {f"/{name}/compressed" for name in pictures}
    written |= {"/tf", "/tf_static", "/clock", "/diagnostics"}
    assert {name for name in written if not recording.counts.get(name)} == set()
    frames = recording.counts["/rover_status"]
    assert frames >= SECONDS * FPS - 2
    for topic in (topics.COMPRESSED_IMAGE, topics.ODOMETRY, topics.FREE_SCAN, topics.COMMAND):
        assert abs(recording.counts[f"/{topic}"] - frames) <= 2, topic
    with bag.file_of(folder).open("rb") as stream:
        assert make_reader(stream).get_summary().statistics.message_count == sum(
            recording.counts.values()
        )
    with Reader(folder) as reader:
        assert len({connection.topic for connection in reader.connections}) == len(recording.topics)
        assert len(list(reader.messages())) == reader.message_count


def test_a_torn_recording_gives_the_same_map(mission, tmp_path):
    content = bag.file_of(mission / "recording").read_bytes()
    torn = tmp_path / "run.mcap"  # as after a kill: neither index nor the last second
    torn.write_bytes(content[: len(content) * 9 // 10])
    out = tmp_path / "replay"
    truth = mission / "world" / "map.png"
    done = rover("replay", str(torn), "--truth", str(truth), "--out", str(out), "--json")
    assert done.returncode == 0, done.stderr
    assert f"{torn}: its recorder was killed; salvaged " in done.stderr
    result = json.loads(done.stdout)
    assert result["frames"] > SECONDS * FPS * 0.7
    assert result["map_cells_different"] == 0
    assert result["percent_mapped"] > 1
    assert (out / "map.png").exists()
    grid = np.fromfile(out / "worldmap.pgm", np.uint8)
    assert np.count_nonzero(grid == 254) > 20


@pytest.mark.parametrize(
    ("name", "content", "problem"),
    [
        ("empty.mcap", b"", "is empty"),
        ("text.mcap", b"no recording", "is not an MCAP file"),
        ("torn.mcap", b"\x89MCAP0\r\n\x01", "holds no message"),
    ],
)
def test_replay_of_what_is_no_recording_is_one_line(tmp_path, name, content, problem, capsys):
    (tmp_path / name).write_bytes(content)
    assert main(["replay", str(tmp_path / name)]) == 1
    assert capsys.readouterr().err == f"rover replay: {tmp_path / name} {problem}\n"


def test_replay_of_a_path_that_is_not_there_is_one_line(tmp_path, capsys):
    assert main(["replay", str(tmp_path / "absent.mcap")]) == 2
    assert "absent.mcap' does not exist" in capsys.readouterr().err
