"""Recordings as people have them: what is skipped is told with its cause and a remedy."""

from __future__ import annotations

import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from rover_simulator.recordings.recording import RecordingError, read_recording
from rover_simulator.recordings.skips import Cause
from rover_tools.cli.main import main

HEADER = "Path;SteerAngle;Throttle;Brake;Speed;X_Position;Y_Position;Pitch;Yaw;Roll"
COUNT = 40
NAMES = [f"robocam_2018_03_01_10_20_{30 + i // 20}_{i % 20 * 50:03d}.jpg" for i in range(COUNT)]
HEADING_DEG = 30.0
LFS_POINTER = b"version https://git-lfs.github.com/spec/v1\noid sha256:1234\nsize 9000\n"


def row(index: int, x: float | None = None, yaw_deg: float = HEADING_DEG) -> str:
    """Of a drive at 2 m/s, 20 frames a second."""
    way = 0.1 * index
    x = 90.0 + way * math.cos(math.radians(HEADING_DEG)) if x is None else x
    y = 80.0 + way * math.sin(math.radians(HEADING_DEG))
    return f"IMG/{NAMES[index]};0.5;0.2;0;2.0;{x:.5f};{y:.5f};0.01;{yaw_deg:.5f};359.9"


ROWS = [row(index) for index in range(COUNT)]


def picture(width: int = 320, height: int = 160) -> bytes:
    return cv2.imencode(".jpg", np.full((height, width, 3), 90, np.uint8))[1].tobytes()


@pytest.fixture
def write(tmp_path):
    def write(lines: list[str], content: bytes | None = None, names: list[str] = NAMES) -> Path:
        (tmp_path / "IMG").mkdir(exist_ok=True)
        for name in names:
            (tmp_path / "IMG" / name).write_bytes(picture() if content is None else content)
        (tmp_path / "robot_log.csv").write_text("\n".join(lines) + "\n")
        return tmp_path

    return write


def test_a_good_recording_has_no_remarks(write):
    recording = read_recording(write([HEADER, *ROWS]))
    assert (len(recording.frames), recording.skips, recording.remarks()) == (COUNT, (), [])


@pytest.mark.parametrize("separator", [",", ";"])
@pytest.mark.parametrize("header", [True, False])
def test_a_separator_in_the_unquoted_path_belongs_to_the_path(write, separator, header):
    good = read_recording(write([HEADER, *ROWS]))
    folder = f"C:\\runs\\one{separator} no brake\\"
    lines = [folder + line.replace("/", "\\").replace(";", separator) for line in ROWS]
    head = [HEADER.replace(";", separator)] if header else []
    recording = read_recording(write([*head, *lines]))
    assert recording.skips == ()
    assert [frame.pose for frame in recording.frames] == [frame.pose for frame in good.frames]


def test_a_decimal_comma_gives_the_same_poses(write):
    good = read_recording(write([HEADER, *ROWS]))
    lines = [line.replace(".", ",").replace(",jpg", ".jpg") for line in ROWS]
    recording = read_recording(write([HEADER, *lines]))
    assert [frame.pose for frame in recording.frames] == [frame.pose for frame in good.frames]


def test_time_goes_on_where_an_older_session_follows(write):
    recording = read_recording(write([HEADER, *ROWS[20:], HEADER, *ROWS[:20]]))
    assert (len(recording.frames), recording.skips) == (COUNT, ())
    assert (np.diff([frame.time for frame in recording.frames]) > 0.0).all()


@pytest.mark.parametrize(
    ("content", "names", "reason", "remedy"),
    [
        (None, [], "none of the 40 pictures was found in {0}/IMG or {0}", "copy the pictures"),
        (LFS_POINTER, NAMES, "a pointer of git-lfs instead of a picture: 40", "git lfs pull"),
        (picture(640, 320), NAMES, "size than 320 x 160: 40 (line 2: {1} has 640 x 320)", "320"),
        (picture()[:-20], NAMES, "no whole JPEG file: 40", "copy the pictures again"),
        (b"\xff\xd8 no JPEG \xff\xd9", NAMES, "no whole JPEG file: 40", "copy the pictures again"),
        (b"", NAMES, "no whole JPEG file: 40", "copy the pictures again"),
    ],
    ids=["missing", "git-lfs", "another size", "cut", "broken", "empty"],
)
def test_no_usable_picture_is_one_line_before_the_graph_starts(
    write, content, names, reason, remedy, capsys
):
    folder = write([HEADER, *ROWS], content, names)
    assert main(["replay", str(folder), "--out", str(folder / "out")]) == 1
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.count("\n") == 1
    assert output.err.startswith("rover replay: ")
    assert reason.format(folder, NAMES[0]) in output.err
    assert remedy in output.err
    assert not (folder / "out").exists()


def test_every_skipped_row_keeps_its_cause(write):
    lines = [HEADER, *ROWS]
    lines[3] = "garbage"
    lines[5] = ROWS[4].replace("2.0", "fast")
    lines[7] = ROWS[6].replace("IMG/robocam", "IMG/lost")
    folder = write(lines)
    (folder / "IMG" / NAMES[10]).write_bytes(LFS_POINTER)
    recording = read_recording(folder)
    assert [(skip.line, skip.cause) for skip in recording.skips] == [
        (4, Cause.CELLS), (6, Cause.CELLS), (8, Cause.NO_PICTURE), (12, Cause.POINTER),
    ]  # fmt: skip
    told = recording.remarks()
    assert told[0].startswith("2 of 40 frames skipped: unreadable row (line 4: 1 cells, not 10)")
    assert len(told) == 3
    assert len(recording.frames) == COUNT - 4


def test_a_log_without_rows_says_so(write):
    with pytest.raises(RecordingError, match="no row below its header"):
        read_recording(write([HEADER]))


@pytest.mark.parametrize("index", [0, 1, 20, 38, 39])
def test_a_position_that_cannot_be_is_skipped(write, index):
    lines = [HEADER, *ROWS]
    lines[1 + index] = row(index, x=150.0)
    (skip,) = read_recording(write(lines)).skips
    assert (skip.line, skip.cause) == (2 + index, Cause.JUMP)


def test_a_new_start_elsewhere_is_no_error(write):
    lines = [HEADER, *ROWS[:20], *(row(index, x=150.0) for index in range(20, 40))]
    assert read_recording(write(lines)).skips == ()


@pytest.mark.parametrize(
    ("yaw_deg", "told"),
    [
        (HEADING_DEG, None),
        (90.0 - 150.0, "nor does it fit cw-from-north"),
        (HEADING_DEG + 180.0, "nor does it fit cw-from-north"),
    ],
)
def test_a_yaw_that_the_motion_contradicts_is_told(write, yaw_deg, told):
    remarks = read_recording(write([HEADER, *(row(i, yaw_deg=yaw_deg) for i in range(COUNT))]))
    lines = remarks.remarks()
    assert len(lines) == (told is not None)
    assert all(told in line for line in lines)


def test_the_other_yaw_convention_is_offered(write):
    folder = turned(write)
    (remark,) = read_recording(folder).remarks()
    assert remark == (
        "the motion contradicts the yaw as ccw-from-east; it fits --yaw-convention cw-from-north"
    )
    assert read_recording(folder, "cw-from-north").remarks() == []


def turned(write) -> Path:
    """A drive to the north-west whose yaw is written clockwise from north."""
    lines = [HEADER]
    for index, name in enumerate(NAMES):
        x, y = 90.0 - 0.09 * index, 80.0 + 0.04 * index
        yaw_deg = math.degrees(math.atan2(-0.09, 0.04))
        lines.append(f"IMG/{name};0;0;0;2.0;{x:.4f};{y:.4f};0;{yaw_deg % 360:.3f};0")
    return write(lines)
