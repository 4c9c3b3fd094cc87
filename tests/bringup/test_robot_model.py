"""The robot model and the views say what the code says."""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as ElementTree

import pytest
from readme_tables import ROOT

from rover_bridge.conversions import static_transforms_of
from rover_bringup.robot_model import robot_model
from rover_common import topics
from rover_common.geometry import Pose, quaternion_from_pose
from rover_common.vehicle import ROVER

FILE = ROOT / "rover_bringup" / "urdf" / "rover.urdf"
LAYOUTS = sorted((ROOT / "rover_bringup" / "foxglove").glob("*.json"))


def joints() -> dict[str, ElementTree.Element]:
    """By the child's name."""
    root = ElementTree.parse(FILE).getroot()
    return {joint.find("child").get("link"): joint for joint in root.findall("joint")}


def numbers(element: ElementTree.Element, name: str) -> list[float]:
    return [float(text) for text in element.find("origin").get(name).split()]


def test_the_file_is_what_the_sizes_make_of_it():
    remedy = "python -m rover_bringup.robot_model > rover_bringup/urdf/rover.urdf"
    assert FILE.read_text() == robot_model(), remedy


def test_the_wheels_stand_where_the_vehicle_has_them():
    front, rear = joints()["front_left_wheel"], joints()["rear_right_wheel"]
    assert numbers(front, "xyz")[:2] == pytest.approx([ROVER.front_axle, ROVER.track / 2])
    assert numbers(rear, "xyz")[:2] == pytest.approx([-ROVER.rear_axle, -ROVER.track / 2])


def test_the_camera_is_where_the_bridge_says():
    sent = {each.child_frame_id: each.transform for each in static_transforms_of(0).transforms}
    for child in ("camera_link", "camera_optical_frame"):
        joint, transform = joints()[child], sent[child]
        at, turn = transform.translation, transform.rotation
        assert numbers(joint, "xyz") == pytest.approx([at.x, at.y, at.z], abs=1e-5)
        roll, pitch, yaw = numbers(joint, "rpy")
        turned = quaternion_from_pose(Pose(0.0, 0.0, yaw, pitch, roll))
        same = sum(a * b for a, b in zip(turned, (turn.x, turn.y, turn.z, turn.w), strict=True))
        assert math.isclose(abs(same), 1.0, abs_tol=1e-4)


@pytest.mark.parametrize("file", LAYOUTS, ids=lambda file: file.stem)
def test_the_layouts_of_foxglove_show_topics_that_there_are(file):
    layout = json.loads(file.read_text())
    names = {value for name, value in vars(topics).items() if name.isupper()} | {"diagnostics"}
    shown = re.findall(r'"/([a-z_/]+[a-z_0-9])', file.read_text())
    assert set(shown) <= names
    placed = set(re.findall(r'"(?:first|second)": "([^"]+)"', file.read_text()))
    assert placed == set(layout["configById"])
