"""The rover as URDF, of the sizes in rover_common.vehicle and rover_common.camera.

    python -m rover_bringup.robot_model > rover_bringup/urdf/rover.urdf

The simulator tells no angles of wheels and arm, so all joints are fixed.
"""

from __future__ import annotations

import math
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from rover_common.camera import ORIGIN_HEIGHT, ROVER_CAMERA
from rover_common.frames import FRAMES
from rover_common.vehicle import ROVER

WHEEL_RADIUS = ROVER.body_front - ROVER.front_axle
WHEEL_WIDTH = 2 * (ROVER.body_half_width - ROVER.track / 2)
AXLE = WHEEL_RADIUS - ORIGIN_HEIGHT  # [m] above base_link's origin
CHASSIS_HEIGHT = 0.12  # [m] of the drawn body, chosen: its size is not published
CAMERA_SIZE = 0.05  # [m] of the drawn camera, chosen
COLOURS = {"body": "0.8 0.8 0.75 1", "wheel": "0.1 0.1 0.1 1", "camera": "0.2 0.3 0.8 1"}


def robot_model() -> str:
    """The file's text."""
    robot = Element("robot", name="rover")
    for name, rgba in COLOURS.items():
        SubElement(SubElement(robot, "material", name=name), "color", rgba=rgba)
    _body(robot)
    for side, aside in (("left", ROVER.track / 2), ("right", -ROVER.track / 2)):
        _wheel(robot, f"front_{side}_wheel", ROVER.front_axle, aside)
        _wheel(robot, f"rear_{side}_wheel", -ROVER.rear_axle, aside)
    _camera(robot)
    indent(robot)
    return '<?xml version="1.0"?>\n' + tostring(robot, encoding="unicode") + "\n"


def _body(robot: Element) -> None:
    """A box between the axles, as wide as the wheels leave it."""
    length = ROVER.front_axle + ROVER.rear_axle
    middle = (ROVER.front_axle - ROVER.rear_axle) / 2
    size = (length, ROVER.track - WHEEL_WIDTH, CHASSIS_HEIGHT)
    visual = _shape(SubElement(robot, "link", name=FRAMES.base), "visual", "body")
    _origin(visual, (middle, 0.0, AXLE))
    SubElement(SubElement(visual, "geometry"), "box", size=_numbers(size))


def _wheel(robot: Element, name: str, forward: float, aside: float) -> None:
    visual = _shape(SubElement(robot, "link", name=name), "visual", "wheel")
    _origin(visual, (0.0, 0.0, 0.0), (math.pi / 2, 0.0, 0.0))
    cylinder = {"radius": f"{WHEEL_RADIUS:.4f}", "length": f"{WHEEL_WIDTH:.4f}"}
    SubElement(SubElement(visual, "geometry"), "cylinder", cylinder)
    _joint(robot, FRAMES.base, name, (forward, aside, AXLE))


def _camera(robot: Element) -> None:
    visual = _shape(SubElement(robot, "link", name=FRAMES.camera), "visual", "camera")
    SubElement(SubElement(visual, "geometry"), "box", size=_numbers((CAMERA_SIZE,) * 3))
    _joint(robot, FRAMES.base, FRAMES.camera, (ROVER_CAMERA.forward, 0.0, ROVER_CAMERA.up))
    SubElement(robot, "link", name=FRAMES.camera_optical)
    optical = (-math.pi / 2, 0.0, -math.pi / 2)  # x right, y down, z forward (REP-103)
    _joint(robot, FRAMES.camera, FRAMES.camera_optical, (0.0, 0.0, 0.0), optical)


def _shape(link: Element, kind: str, colour: str) -> Element:
    shape = SubElement(link, kind)
    SubElement(shape, "material", name=colour)
    return shape


def _joint(
    robot: Element,
    parent: str,
    child: str,
    xyz: tuple[float, float, float],
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> None:
    joint = SubElement(robot, "joint", name=f"{child}_joint", type="fixed")
    SubElement(joint, "parent", link=parent)
    SubElement(joint, "child", link=child)
    _origin(joint, xyz, rpy)


def _origin(
    element: Element,
    xyz: tuple[float, float, float],
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> None:
    SubElement(element, "origin", xyz=_numbers(xyz), rpy=_numbers(rpy))


def _numbers(values: tuple[float, ...]) -> str:
    return " ".join(f"{value:.6g}" for value in values)


if __name__ == "__main__":
    print(robot_model(), end="")
