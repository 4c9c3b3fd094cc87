"""ROS messages and QoS profiles to what a recording holds, and back."""

from __future__ import annotations

import importlib
import struct
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import CompressedImage, Image

from rover_common.jpeg import sharp_jpeg
from rover_common.ros.conversions import NANOSECONDS, image_of, jpeg_message_of
from rover_recorder.errors import RecordingError

JPEG_QUALITY = 85
STAMP = {1: struct.Struct("<4xiI"), 0: struct.Struct(">4xiI")}  # by the byte order of the CDR
DEPTH = 100  # messages of a topic that may wait for this process


def type_of(kind: str) -> Any:
    """The class of a type like `std_msgs/msg/String`; raises RecordingError."""
    package, group, name = kind.split("/")
    try:
        return getattr(importlib.import_module(f"{package}.{group}"), name)
    except (ImportError, AttributeError):
        raise RecordingError(f"the type {kind} is not installed") from None


def message_of(kind: str, data: bytes) -> Any:
    """A message of such a type from its CDR bytes; raises RecordingError."""
    try:
        return deserialize_message(data, type_of(kind))
    except RuntimeError as error:
        raise RecordingError(f"a message is no {kind}: {error}") from error


def stamp_in(data: bytes) -> int:
    """[ns] The time at the begin of a serialized message."""
    seconds, nanoseconds = STAMP[data[1] & 1].unpack_from(data)
    return int(seconds * NANOSECONDS + nanoseconds)


def compressed_of(message: Image) -> CompressedImage:
    """An rgb8 image as a JPEG file; raises MessageError for another encoding.

    The colours are not subsampled: pictures made by the graph have sharp edges between colours.
    """
    return jpeg_message_of(message.header, sharp_jpeg(image_of(message), JPEG_QUALITY))


def subscription_profile(offered: list[QoSProfile]) -> QoSProfile:
    """What all the publishers of a topic fit: reliable, and latched, only where each of them is."""
    reliable = all(p.reliability == ReliabilityPolicy.RELIABLE for p in offered)
    latched = all(p.durability == DurabilityPolicy.TRANSIENT_LOCAL for p in offered)
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def qos_words(profile: QoSProfile) -> dict[str, Any]:
    """A profile as rosbag2 writes it into its metadata."""
    return {
        "history": profile.history.name.lower(),
        "depth": profile.depth,
        "reliability": profile.reliability.name.lower(),
        "durability": profile.durability.name.lower(),
        "deadline": _time_words(profile.deadline),
        "lifespan": _time_words(profile.lifespan),
        "liveliness": profile.liveliness.name.lower(),
        "liveliness_lease_duration": _time_words(profile.liveliness_lease_duration),
        "avoid_ros_namespace_conventions": profile.avoid_ros_namespace_conventions,
    }


def _time_words(duration: Duration) -> dict[str, int]:
    seconds, nanoseconds = divmod(duration.nanoseconds, NANOSECONDS)
    return {"sec": seconds, "nsec": nanoseconds}
