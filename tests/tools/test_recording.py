"""Recorded runs as people have them: both separators, foreign paths, corrupt rows."""

import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from rover_simulator.recordings.clock import NOMINAL_PERIOD
from rover_simulator.recordings.recording import RecordingError, read_recording

HEADER = "Path;SteerAngle;Throttle;Brake;Speed;X_Position;Y_Position;Pitch;Yaw;Roll"
NAMES = ("robocam_2017_05_02_11_16_21_421.jpg", "robocam_2017_05_02_11_16_21_455.jpg")
VALUES = ("7.5", "1", "0", "2.5", "99.67", "85.589", "359.0", "90.0", "2.0")


def write(folder: Path, lines: list[str], names: tuple[str, ...] = NAMES) -> Path:
    (folder / "IMG").mkdir()
    for name in names:
        cv2.imwrite(str(folder / "IMG" / name), np.zeros((160, 320, 3), np.uint8))
    (folder / "robot_log.csv").write_text("\n".join(lines) + "\n")
    return folder


def row(path: str, values: tuple[str, ...] = VALUES, separator: str = ";") -> str:
    return separator.join((path, *values))


def test_a_row_is_read_in_si_and_ros_conventions(tmp_path):
    recording = read_recording(write(tmp_path, [HEADER, row(f"IMG/{NAMES[0]}")]))
    (frame,) = recording.frames
    assert recording.skips == ()
    assert frame.image_path.name == NAMES[0]
    assert frame.steering_angle == pytest.approx(math.radians(7.5))
    assert (frame.throttle, frame.brake, frame.speed) == (1.0, 0.0, 2.5)
    assert (frame.pose.x, frame.pose.y) == (99.67, 85.589)
    assert frame.pose.yaw == pytest.approx(math.pi / 2)
    assert frame.pose.pitch == pytest.approx(math.radians(-1.0))  # 359 degrees: nose up
    assert frame.pose.roll == pytest.approx(math.radians(-2.0))  # right side up


def test_times_come_from_the_file_names(tmp_path):
    lines = [HEADER, *(row(f"IMG/{name}") for name in NAMES)]
    frames = read_recording(write(tmp_path, lines)).frames
    assert [frame.time for frame in frames] == pytest.approx([0.0, 0.034])


def test_frames_without_times_have_the_nominal_period(tmp_path):
    names = ("a.jpg", "b.jpg")
    lines = [HEADER, *(row(name) for name in names)]
    frames = read_recording(write(tmp_path, lines, names)).frames
    assert [frame.time for frame in frames] == pytest.approx([0.0, NOMINAL_PERIOD])


@pytest.mark.parametrize(
    "path",
    [f"/home/someone/run/IMG/{NAMES[0]}", f"C:\\Users\\someone\\IMG\\{NAMES[0]}", NAMES[0]],
)
def test_only_the_file_name_of_a_path_counts(tmp_path, path):
    assert len(read_recording(write(tmp_path, [HEADER, row(path)])).frames) == 1


@pytest.mark.parametrize(
    ("header", "line"),
    [
        (HEADER.replace(";", ","), row(NAMES[0], separator=",")),
        (HEADER, row(NAMES[0], tuple(v.replace(".", ",") for v in VALUES))),
        ("", row(NAMES[0])),
        ("\ufeff" + HEADER, row(NAMES[0])),
    ],
    ids=["comma separated", "decimal comma", "no header", "byte order mark"],
)
def test_variants_of_the_log_are_read(tmp_path, header, line):
    (frame,) = read_recording(write(tmp_path, [header, line])).frames
    assert (frame.pose.x, frame.speed) == (99.67, 2.5)


@pytest.mark.parametrize(
    "bad",
    [
        "garbage",
        row(NAMES[0], ("nan", *VALUES[1:])),
        row(NAMES[0], (*VALUES[:3], "inf", *VALUES[4:])),
        row(NAMES[0], (*VALUES[:3], "fast", *VALUES[4:])),
        row(NAMES[0], VALUES[:5]),
        row("IMG/missing.jpg"),
        row(""),
        "\0\0\0",
    ],
)
def test_a_corrupt_row_is_skipped_and_counted(tmp_path, bad):
    recording = read_recording(write(tmp_path, [HEADER, row(NAMES[0]), bad, row(NAMES[1])]))
    assert len(recording.frames) == 2
    assert len(recording.skips) == 1


def test_yaw_clockwise_from_north(tmp_path):
    values = (*VALUES[:7], "30.0", VALUES[8])
    folder = write(tmp_path, [HEADER, row(NAMES[0], values)])
    (frame,) = read_recording(folder, "cw-from-north").frames
    assert frame.pose.yaw == pytest.approx(math.radians(60.0))


def test_no_log_is_one_clear_error(tmp_path):
    with pytest.raises(RecordingError, match=r"robot_log\.csv"):
        read_recording(tmp_path)


def test_no_usable_row_is_one_clear_error(tmp_path):
    with pytest.raises(RecordingError, match="no usable row among 1"):
        read_recording(write(tmp_path, [HEADER, "garbage"]))


def test_the_real_recordings_are_read_whole(recordings):
    for name in ("udacity/test_dataset", "recordings/long", "recordings/medium", "recordings/arm"):
        recording = read_recording(recordings / name)
        assert recording.skips == ()
        assert len(recording.frames) == len(list((recordings / name / "IMG").glob("*.jpg")))
