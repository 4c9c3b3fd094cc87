"""`rover explain`: which frame it shows, what it shows of it, and its errors."""

from __future__ import annotations

import math
from pkgutil import resolve_name

import cv2
import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rclpy.serialization import serialize_message
from readme_tables import ROOT
from rover_interfaces.msg import RoverStatus
from sensor_msgs.msg import CompressedImage

from rover_common import topics
from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose
from rover_common.grid import WORLD
from rover_common.map_encoding import navigable_cells
from rover_common.ros import conversions
from rover_perception.camera.ground_projection import GroundProjection
from rover_recorder import bag
from rover_recorder.schemas import definition
from rover_recorder.types import Topic
from rover_recorder.writer import RecordingWriter
from rover_simulator.recordings.recording import read_recording
from rover_tools.cli.main import main
from rover_tools.explain import frames as explain_frames
from rover_tools.explain.frames import ExplainError, FrameChoice, load_image, load_run
from rover_tools.explain.our_panels import top_view
from rover_tools.explain.our_stages import run_our_stages
from rover_tools.explain.panels import STAGES
from rover_tools.explain.picture import stage_panels
from rover_tools.runner.recorded_run import FRAME_TYPES

RUN = ROOT / "docs" / "examples" / "recording"
WITH_ROCK = 132  # a frame whose image shows a sample


@pytest.fixture(scope="module")
def pairs():
    return stage_panels(load_run(RUN, FrameChoice(number=WITH_ROCK)))


def test_every_stage_is_shown_in_both_ways(pairs):
    assert [ours.stage for ours, _ in pairs] == list(STAGES)
    assert [baseline.stage for _, baseline in pairs] == list(STAGES)


def test_each_name_below_a_panel_is_one_of_the_code(pairs):
    names = {name for pair in pairs for panel in pair for name in panel.names}
    assert all(panel.names for pair in pairs for panel in pair)
    assert len(names) > len(STAGES)
    for name in names:
        resolve_name(name)  # raises for what is not there


def test_the_stages_are_those_of_the_chosen_frame():
    stages = run_our_stages(load_run(RUN, FrameChoice(number=WITH_ROCK)))
    frame = read_recording(RUN).frames[WITH_ROCK]
    assert stages.pose == frame.pose
    assert len(stages.frames) == WITH_ROCK + 1
    assert len(stages.sightings.x) == 1
    (rock,) = stages.result.rocks  # the frames before it confirm it
    assert math.dist((rock.x, rock.y), (113.188, 94.188)) < 1.0  # as samples.csv has it
    row, col = int(frame.pose.y), int(frame.pose.x)
    assert navigable_cells(stages.grid.cells)[row, col]
    assert stages.evidence.free.sum() > 0


@pytest.mark.parametrize(
    ("choice", "number"),
    [
        (FrameChoice(), 199),
        (FrameChoice(number=0), 0),
        (FrameChoice(number=199), 199),
        (FrameChoice(time=0.0), 0),
        (FrameChoice(time=0.99), 24),
        (FrameChoice(time=1.0), 25),
    ],
)
def test_a_frame_is_chosen_by_its_number_or_its_time(choice, number):
    source = load_run(RUN, choice)
    assert source.frames[-1].pose == read_recording(RUN).frames[number].pose
    assert f"frame {number} " in source.title


def test_a_long_run_is_mapped_from_its_last_frames_only(monkeypatch):
    monkeypatch.setattr(explain_frames, "MOST_FRAMES", 7)
    source = load_run(RUN, FrameChoice(number=50))
    poses = [frame.pose for frame in read_recording(RUN).frames[44:51]]
    assert [frame.pose for frame in source.frames] == poses


def test_an_image_has_the_tilt_that_is_given():
    image = RUN / "IMG" / "frame_00132.jpg"
    level = run_our_stages(load_image(image, 0.0, 0.0))
    tilted = run_our_stages(load_image(image, 0.02, -0.01))
    assert tilted.pose == Pose(WORLD.start_x, WORLD.start_y, 0.0, 0.02, -0.01)
    assert tilted.projection.horizon(np.array([160.0])) < level.projection.horizon(
        np.array([160.0])
    )


def test_the_top_view_has_each_point_of_the_ground_at_its_place():
    image = np.zeros((ROVER_CAMERA.height, ROVER_CAMERA.width, 3), np.uint8)
    projection = GroundProjection.of(ROVER_CAMERA, Pose(50.0, 50.0, 0.0, 0.01, 0.01))
    u, v, _ = projection.pixels(np.array([2.0]), np.array([0.5]))
    image[int(v[0]), int(u[0])] = 255
    seen, inside = top_view(image, projection)
    row, col = np.nonzero(seen[..., 0])
    assert inside[row, col].all()
    x, y = 10.0 - (row + 0.5) * 0.025, 8.0 - (col + 0.5) * 0.025
    assert math.dist((x.mean(), y.mean()), (2.0, 0.5)) < 0.1
    assert not inside[-1].any()  # below the rover


def write_mcap(folder, count: int = 4):
    """The example's first frames as a graph records them: an image is one frame older."""
    frames = read_recording(RUN).frames
    with RecordingWriter(bag.file_of(folder)) as writer:
        for topic, kind in FRAME_TYPES.items():
            writer.add_topic(Topic(f"/{topic}", kind, definition(kind)))
        for number in range(count):
            stamp = 1_000_000_000 + number * 40_000_000
            header = conversions.header_of(stamp, "map")
            jpeg = frames[max(0, number - 1)].image_path.read_bytes()
            messages: dict[str, CompressedImage | Odometry | RoverStatus] = {
                topics.COMPRESSED_IMAGE: conversions.jpeg_message_of(header, jpeg),
                topics.ODOMETRY: conversions.odometry_of(stamp, frames[number].pose, 1.0),
                topics.STATUS: RoverStatus(header=header, run=3),
            }
            for topic, message in messages.items():
                writer.write(f"/{topic}", stamp, stamp, serialize_message(message))
    return folder


@pytest.mark.parametrize("named", ["folder", "file"])
def test_a_recorded_image_is_paired_with_the_pose_at_which_it_was_taken(tmp_path, named):
    folder = write_mcap(tmp_path / "run")
    path = folder if named == "folder" else bag.file_of(folder)
    stages = run_our_stages(load_run(path, FrameChoice(time=0.08)))
    frame = read_recording(RUN).frames[1]
    assert (stages.pose.x, stages.pose.y) == pytest.approx((frame.pose.x, frame.pose.y))
    picture = cv2.cvtColor(cv2.imread(str(frame.image_path)), cv2.COLOR_BGR2RGB)
    assert np.array_equal(stages.image, picture)
    assert stages.frames[-1].run.number == 3


def test_the_command_writes_one_picture(tmp_path, capsys):
    out = tmp_path / "stages.png"
    arguments = [str(RUN / "IMG" / "frame_00132.jpg"), "--pitch", "-1", "--roll", "0.9"]
    assert main(["explain", *arguments, "--out", str(out)]) == 0
    picture = cv2.imread(str(out))
    assert picture.shape[0] > 1000
    assert picture.shape[1] > 1000
    assert capsys.readouterr().err == f"look at {out}\n"


def test_without_a_file_the_picture_is_a_result(tmp_path, monkeypatch):
    monkeypatch.setenv("ROVER_RESULTS", str(tmp_path))
    assert main(["explain", str(RUN), "--frame", "0"]) == 0
    (folder,) = tmp_path.iterdir()
    assert (folder / "explain.png").is_file()


@pytest.mark.parametrize("content", [b"", b"no picture"])
def test_what_is_no_picture_is_one_line(tmp_path, capsys, content):
    path = tmp_path / "note.jpg"
    path.write_bytes(content)
    assert main(["explain", str(path)]) == 1
    assert capsys.readouterr().err == f"rover explain: {path} is no picture that can be read\n"


def test_a_picture_of_another_camera_is_one_line(tmp_path, capsys):
    path = tmp_path / "photo.png"
    cv2.imwrite(str(path), np.zeros((480, 640, 3), np.uint8))
    assert main(["explain", str(path)]) == 1
    error = capsys.readouterr().err
    assert error == f"rover explain: {path} is 640 x 480; the camera's pictures are 320 x 160\n"


@pytest.mark.parametrize(
    ("choice", "text"),
    [(FrameChoice(number=200), "no frame 200: it holds 0 to 199"),
     (FrameChoice(time=9.0), "ends after 7.96 s, before 9 s")],
)  # fmt: skip
def test_a_frame_that_is_not_there_is_told(choice, text):
    with pytest.raises(ExplainError, match=text):
        load_run(RUN, choice)


def test_a_rover_on_its_side_is_told(capsys):
    image = str(RUN / "IMG" / "frame_00132.jpg")
    assert main(["explain", image, "--pitch", "59.9", "--roll", "59.9", "--out", "x.png"]) == 1
    assert "lies on its side" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "code", "text"),
    [
        ([str(ROOT / "docs" / "images")], 1, "holds no recording"),
        ([str(RUN), "--frame", "1", "--time", "1"], 2, "--frame and --time exclude each other"),
        ([str(RUN), "--pitch", "1"], 2, "--pitch and --roll are for one image"),
        ([str(RUN / "IMG" / "frame_00132.jpg"), "--frame", "1"], 2, "--frame and --time are for"),
        (["missing.png"], 2, "does not exist"),
        ([str(RUN), "--frame", "-1"], 2, "is not in the range 0 or more"),
        ([str(RUN), "--pitch", "61"], 2, "is not in the range -60 to 60"),
    ],
)
def test_what_cannot_be_used_is_one_line(arguments, code, text, capsys):
    assert main(["explain", *arguments]) == code
    error = capsys.readouterr().err
    assert text in error
    assert error.count("\n") == 1
