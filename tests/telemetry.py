"""Telemetry for tests."""

from __future__ import annotations

import base64
from typing import Any

import cv2
import numpy as np

from rover_common.geometry import Pose
from rover_simulator.wire.telemetry_format import format_telemetry

START = Pose(99.67, 85.589, 0.9918)


def jpeg(level: int = 128, width: int = 320, height: int = 160) -> bytes:
    """A grey JPEG file with some texture, so that it is about as large as a real one."""
    noise = np.random.default_rng(0).normal(level, 8, (height, width, 3))
    data = cv2.imencode(
        ".jpg", np.clip(noise, 0, 255).astype(np.uint8), [cv2.IMWRITE_JPEG_QUALITY, 75]
    )[1]
    return bytes(data.tobytes())


IMAGE = jpeg()


def telemetry(**changes: Any) -> dict[str, str]:
    """A telemetry object of a standing rover at the start, with these values changed."""
    values: dict[str, Any] = {
        "pose": START,
        "speed": 0.0,
        "throttle": 0.0,
        "brake": 0.0,
        "steering_angle": 0.0,
        "near_sample": False,
        "picking_up": False,
        "sample_count": 2,
        "samples": ((109.78, 89.84), (62.63, 96.25)),
        "image": IMAGE,
    }
    return format_telemetry(**(values | changes))


def claiming(width: int, height: int) -> bytes:
    """The picture, with another size in its header."""
    frame = IMAGE.index(b"\xff\xc0")
    size = height.to_bytes(2, "big") + width.to_bytes(2, "big")
    return IMAGE[: frame + 5] + size + IMAGE[frame + 9 :]


def picture_bomb() -> str:
    """A picture that claims 32760 x 32760 pixels, in base64."""
    return base64.b64encode(claiming(32760, 32760)).decode()
