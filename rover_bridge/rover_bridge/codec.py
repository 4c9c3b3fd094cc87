"""Telemetry objects to SI and REP-103, commands to what the simulator can take."""

from __future__ import annotations

import base64
import binascii
import math
from collections.abc import Mapping
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_bridge import jpeg_header
from rover_bridge.errors import (
    Base64Error,
    ImageSizeError,
    JpegError,
    MissingKeyError,
    NotAnObjectError,
    NumberError,
    OutOfRangeError,
)
from rover_bridge.insets import NO_INSETS, Insets
from rover_bridge.numbers import parse_number, parse_numbers
from rover_common.camera import ROVER_CAMERA
from rover_common.geometry import Pose, wrap_angle
from rover_common.types import Command, Telemetry
from rover_common.vehicle import ROVER

# Far beyond what the simulator can reach, near enough to catch a wrong separator or unit.
POSITION_LIMIT = 1000.0  # [m]; the world is 200 m wide
SPEED_LIMIT = 100.0  # [m/s]; the rover reaches 5
ANGLE_LIMIT_DEG = 720.0
# The simulator takes any throttle; published programs for it back out of a stop with 2 and 3.
THROTTLE_LIMIT = 3.0
COUNT_LIMIT = 1000  # samples; the world has 6
TIME_LIMIT = 1e9  # [s]

MAX_IMAGE_TEXT = jpeg_header.MAX_BYTES * 4 // 3 + 4  # characters of base64
# Where its data ends, a JPEG decoder leaves the rest of the picture at this level.
UNDECODED = 128
# More data, of no meaning: a decoder that had all it needs leaves it alone.
# It begins with 0, as a file may be cut within FF 00, the code of a byte FF.
EXTRA_DATA = bytes(range(128))

Wire = Mapping[str, Any]


def decode_telemetry(wire: object) -> Telemetry:
    """Decode the object of a telemetry event; keys that are not known are left alone.

    Raises a TelemetryError of the kind of its defect.
    """
    if not isinstance(wire, Mapping):
        raise NotAnObjectError(f"telemetry is {type(wire).__name__}, expected an object")
    count = int(_bounded(wire, "sample_count", 0, COUNT_LIMIT))
    jpeg = _jpeg(wire)
    return Telemetry(
        pose=_pose(wire),
        speed=_bounded(wire, "speed", -SPEED_LIMIT, SPEED_LIMIT),
        throttle=_number(wire, "throttle"),
        brake=_number(wire, "brake"),
        steering_angle=math.radians(_angle_deg(wire, "steering_angle")),
        near_sample=_flag(wire, "near_sample"),
        picking_up=_flag(wire, "picking_up"),
        sample_count=count,
        samples=_samples(wire, count),
        image=decode_jpeg(jpeg),
        jpeg=jpeg,
        sim_time=_bounded(wire, "sim_time", 0.0, TIME_LIMIT) if "sim_time" in wire else None,
    )


def decode_jpeg(data: bytes) -> NDArray[np.uint8]:
    """An image (height, width, 3) RGB of the camera's size; raises JpegError or ImageSizeError.

    Nothing of another size or kind is decoded: a file of 1 kB may claim a picture of gigabytes.
    """
    header = jpeg_header.read_header(data)
    if (header.width, header.height) != (ROVER_CAMERA.width, ROVER_CAMERA.height):
        raise ImageSizeError(f"image is {header.width} x {header.height} pixels")
    image = _pixels(data)
    # The decoder fills what is missing with grey instead of refusing it. A picture that is grey
    # there itself is the same with more data behind it.
    if np.all(image[-4:, -4:] == UNDECODED):
        longer = data.removesuffix(jpeg_header.END) + EXTRA_DATA + jpeg_header.END
        if not np.array_equal(image, _pixels(longer)):
            raise JpegError("image ends before its last row")
    return image


def _pixels(data: bytes) -> NDArray[np.uint8]:
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    except cv2.error:
        image = None
    if image is None:
        raise JpegError("image cannot be decoded")
    if image.shape != (ROVER_CAMERA.height, ROVER_CAMERA.width, 3):  # as after a rotation by EXIF
        raise ImageSizeError(f"image is {image.shape[1]} x {image.shape[0]} pixels")
    return cv2.cvtColor(image, cv2.COLOR_BGR2RGB).astype(np.uint8, copy=False)


def decimal_mark(wire: object) -> str:
    """That of the machine that wrote this telemetry, "." or ","; "" where its speed shows none."""
    speed = wire.get("speed") if isinstance(wire, Mapping) else None
    marks = [mark for mark in ".," if mark in speed] if isinstance(speed, str) else []
    return marks[0] if len(marks) == 1 else ""


def shows_insets(wire: object) -> bool:
    """Whether the client that sent this telemetry shows the insets of its answers.

    Its `shows_insets` says so. The original has no such key, and shows them; a telemetry with a
    clock is not the original's.
    """
    if not isinstance(wire, Mapping):
        return False
    said = wire.get("shows_insets")
    return "sim_time" not in wire if said is None else str(said) == "1"


def encode_drive(
    command: Command,
    decimal_comma: bool = False,
    insets: Insets = NO_INSETS,
    refused: str = "",
) -> dict[str, str]:
    """The object of a `data` event; a value that is not finite becomes the safe brake.

    refused: why the telemetry was not used; empty when it was.
    """
    values = (command.steering_angle, command.throttle, command.brake)
    if not all(math.isfinite(value) for value in values):
        values = (0.0, 0.0, 1.0)
    steering, throttle, brake = values
    steering_deg = math.degrees(max(-ROVER.max_steering, min(ROVER.max_steering, steering)))
    drive = {
        "steering_angle": f"{steering_deg:.4f}",
        "throttle": f"{max(-THROTTLE_LIMIT, min(THROTTLE_LIMIT, throttle)):.4f}",
        "brake": f"{max(0.0, brake):.4f}",
    }
    if decimal_comma:  # the simulator parses in its machine's culture
        drive = {key: value.replace(".", ",") for key, value in drive.items()}
    drive |= {"inset_image1": insets.map, "inset_image2": insets.birdseye}
    return drive | {"refused": refused} if refused else drive


def _pose(wire: Wire) -> Pose:
    x, y = parse_numbers(_value(wire, "position"), 2)
    if max(abs(x), abs(y)) > POSITION_LIMIT:
        raise OutOfRangeError(f"position {x:g}, {y:g} m")
    return Pose(
        x,
        y,
        yaw=wrap_angle(math.radians(_angle_deg(wire, "yaw"))),
        pitch=wrap_angle(math.radians(_angle_deg(wire, "pitch"))),
        roll=wrap_angle(-math.radians(_angle_deg(wire, "roll"))),  # theirs: right side up
    )


def _samples(wire: Wire, count: int) -> NDArray[np.float64]:
    x = parse_numbers(_value(wire, "samples_x"), count)
    y = parse_numbers(_value(wire, "samples_y"), count)
    return np.array([x, y], np.float64).T.reshape(-1, 2)


def _jpeg(wire: Wire) -> bytes:
    text = _value(wire, "image")
    if not isinstance(text, str):
        raise Base64Error(f"image is {type(text).__name__}, expected a string")
    if len(text) > MAX_IMAGE_TEXT:
        raise JpegError(f"image has {len(text)} characters")
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError) as error:
        raise Base64Error(f"image: {error}") from None


def _value(wire: Wire, key: str) -> Any:
    try:
        return wire[key]
    except KeyError:
        raise MissingKeyError(f"telemetry has no '{key}'") from None


def _number(wire: Wire, key: str) -> float:
    try:
        return parse_number(_value(wire, key))
    except NumberError as error:
        raise type(error)(f"{key}: {error}") from None


def _bounded(wire: Wire, key: str, low: float, high: float) -> float:
    value = _number(wire, key)
    if not low <= value <= high:
        raise OutOfRangeError(f"{key} is {value:g}")
    return value


def _angle_deg(wire: Wire, key: str) -> float:
    return _bounded(wire, key, -ANGLE_LIMIT_DEG, ANGLE_LIMIT_DEG)


def _flag(wire: Wire, key: str) -> bool:
    return _bounded(wire, key, 0, 1) == 1
