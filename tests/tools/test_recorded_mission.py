"""The report of a recorded mission, from a recording written here."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from mission_logs import ROCK, ROOM, TRUTH, grid_of
from rclpy.serialization import serialize_message
from rover_interfaces.msg import MissionState

from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros.conversions import (
    grid_message_of,
    header_of,
    jpeg_message_of,
    odometry_of,
    rocks_message_of,
)
from rover_common.types import FIRST_RUN
from rover_recorder.bag import file_of
from rover_recorder.errors import RecordingError
from rover_recorder.types import Topic
from rover_recorder.writer import RecordingWriter
from rover_tools.cli.main import main
from rover_tools.evaluation.results import Truth
from rover_tools.report.recorded_mission import read_mission

FPS = 10
STATES = ((0.0, "FORWARD"), (4.0, "PICKUP"), (6.0, "RETURN_HOME"), (9.0, "DONE"))
TYPES = {
    topics.ODOMETRY: "nav_msgs/msg/Odometry",
    topics.MISSION_STATE: "rover_interfaces/msg/MissionState",
    topics.WORLDMAP: "nav_msgs/msg/OccupancyGrid",
    topics.ROCKS: "rover_interfaces/msg/RockTrackArray",
    topics.COMPRESSED_IMAGE: "sensor_msgs/msg/CompressedImage",
}


class Recorded:
    """A recording under construction; times are [s] of the simulator."""

    def __init__(self, folder: Path, namespace: str = "") -> None:
        self._writer = RecordingWriter(file_of(folder))
        self._prefix = f"{namespace}/"
        for topic, kind in TYPES.items():
            self._writer.add_topic(Topic(self._prefix + topic, kind, "", type_hash=""))
        self._order = 0

    def write(self, topic: str, time: float, message: Any) -> None:
        self._order += 1
        data = serialize_message(message)
        self._writer.write(self._prefix + topic, self._order, round(time * 1e9), data)

    def mission(self, start: float, *, x: float = 50.0, states=STATES) -> None:
        """Ten seconds to the east at 1 m/s from x [m] on, half of the room mapped from 5 s on."""
        half = ROOM & (np.arange(200) < 80)
        red = np.zeros((160, 320, 3), np.uint8)
        red[..., 2] = 200
        jpeg = cv2.imencode(".jpg", red)[1].tobytes()
        changes = dict(states)
        end = states[-1][0]
        for frame in range(int(end * FPS) + 1):
            elapsed = frame / FPS
            time = start + elapsed
            stamp = round(time * 1e9)
            image = jpeg_message_of(header_of(stamp, "camera"), jpeg)
            self.write(topics.COMPRESSED_IMAGE, time, image)
            odometry = odometry_of(stamp, Pose(x + elapsed, 75.0, 0.0), 1.0)
            self.write(topics.ODOMETRY, time, odometry)
            if frame == 5 * FPS:
                self.write(topics.WORLDMAP, time, grid_message_of(stamp, grid_of(half)))
                rocks = rocks_message_of(stamp, FIRST_RUN, (ROCK,), stamp)
                self.write(topics.ROCKS, time, rocks)
            if elapsed in changes:
                state = MissionState(
                    header=header_of(stamp, "map"), state_name=changes[elapsed], reason="because",
                    elapsed=elapsed, samples_total=3, samples_collected=int(elapsed > 4),
                    home_distance=elapsed, explored=elapsed / 10,
                )  # fmt: skip
                self.write(topics.MISSION_STATE, time, state)

    def close(self) -> Path:
        self._writer.close()
        return self._writer.path.parent


@pytest.fixture
def recorded(tmp_path) -> Recorded:
    return Recorded(tmp_path / "recording")


def test_the_track_and_the_states_are_those_of_the_mission(recorded):
    recorded.mission(100.0)
    mission = read_mission(recorded.close(), TRUTH)
    log = mission.log("recorded", {})
    assert [round(point.time) for point in log.track] == list(range(10))
    assert [point.x for point in log.track] == pytest.approx([50.0 + t for t in range(10)], abs=0.2)
    assert [change.state for change in log.changes] == [state for _, state in STATES]
    assert [change.time for change in log.changes] == pytest.approx([0, 4, 6, 9], abs=0.2)


def test_without_a_truth_the_track_has_progress_all_the_same(recorded):
    recorded.mission(100.0)
    last = read_mission(recorded.close(), Truth()).log("recorded", {}).track[-1]
    assert (last.time, last.x, last.speed, last.state) == (9.0, 59.0, 1.0, "DONE")
    assert (last.samples, last.home_distance, last.explored) == (1, 9.0, 90.0)
    assert (last.mapped_area, last.percent_mapped, last.fidelity) == (1200.0, None, None)


def test_the_map_counts_from_when_it_came(recorded):
    recorded.mission(100.0)
    log = read_mission(recorded.close(), TRUTH).log("recorded", {})
    assert [point.percent_mapped for point in log.track] == [None] * 6 + [50.0] * 4
    assert [(rock.x, rock.y) for rock in log.rocks] == [(ROCK.x, ROCK.y)]


def test_of_several_missions_the_last_counts(recorded):
    recorded.mission(100.0, x=50.0)
    recorded.mission(200.0, x=70.0, states=((0.0, "FORWARD"), (3.0, "DONE")))
    log = read_mission(recorded.close(), Truth()).log("recorded", {})
    assert (log.track[0].x, log.track[-1].x) == (pytest.approx(70.0, abs=0.2), 73.0)
    assert [change.state for change in log.changes] == ["FORWARD", "DONE"]


def test_a_clock_that_is_set_back_begins_another_mission(recorded):
    recorded.mission(100.0)
    recorded.mission(1.0, x=70.0)
    log = read_mission(recorded.close(), Truth()).log("recorded", {})
    assert [round(point.x) for point in log.track] == list(range(70, 80))


def test_topics_in_a_namespace_are_found(tmp_path):
    recorded = Recorded(tmp_path / "recording", "/rover")
    recorded.mission(100.0)
    assert len(read_mission(recorded.close(), Truth()).moments) == 11


def test_snapshots_are_few_enough_and_end_with_the_mission(recorded):
    recorded.mission(100.0)
    mission = read_mission(recorded.close(), TRUTH)
    snapshots = list(mission.snapshots(4))
    assert len(snapshots) <= 4
    last = snapshots[-1]
    assert (last.moment.state, last.samples_total) == ("DONE", 3)
    assert last.score == (50.0, 100.0)
    assert last.vision is None
    assert np.allclose(last.camera[80, 160], (200, 0, 0), atol=10)
    assert last.rocks.tolist() == [[ROCK.x, ROCK.y]]


def test_a_recording_without_a_mission_is_one_sentence(recorded):
    recorded.write(topics.ODOMETRY, 1.0, odometry_of(10**9, Pose(50.0, 75.0, 0.0), 0.0))
    with pytest.raises(RecordingError, match="holds no mission"):
        read_mission(recorded.close(), Truth())


def test_the_command_leaves_report_video_track_and_result(recorded, tmp_path, capsys):
    recorded.mission(100.0)
    out = tmp_path / "out"
    assert main(["report", str(recorded.close()), "--out", str(out), "--json"]) == 0
    files = ("mission.webm", "report.html", "result.json", "track.csv")
    assert sorted(path.name for path in out.iterdir()) == list(files)
    assert '"done": true' in capsys.readouterr().out
    rows = list(csv.DictReader((out / "track.csv").open()))
    assert (rows[-1]["state"], float(rows[-1]["mapped_area"])) == ("DONE", 1200.0)
    page = (out / "report.html").read_text()
    assert 'src="mission.webm"' in page
    assert "Mapped ground [m²]" in page
