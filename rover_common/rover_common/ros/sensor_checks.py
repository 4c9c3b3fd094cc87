"""What the sensors' messages must be like, and those of wheels; see message_checks."""

from __future__ import annotations

import math

from geometry_msgs.msg import Twist, TwistStamped
from sensor_msgs.msg import CompressedImage, Imu, LaserScan
from std_msgs.msg import Float32MultiArray

from rover_common.burger import BURGER
from rover_common.ros.check_values import (
    FARTHEST,
    check_count,
    check_header,
    check_rotation,
    check_within,
)
from rover_common.ros.message_errors import EncodingError, RangeError, SizeError

MOST_BYTES = 100_000_000  # of a picture
JPEG_BEGIN = b"\xff\xd8\xff"
MOST_RAYS = 100_000
TWO_TURNS = 4.0 * math.pi  # [rad]
LONGEST_SCAN = 10.0  # [s]
FASTEST = 1000.0  # [m/s] and [rad/s]
HARDEST = 10_000.0  # [m/s^2]


def check_jpeg(message: CompressedImage) -> None:
    check_header(message.header)
    check_count("bytes", message.data, MOST_BYTES)
    if message.data[: len(JPEG_BEGIN)].tobytes() != JPEG_BEGIN:
        raise EncodingError(f"no JPEG file, format '{message.format:.40}'")


def check_scan(message: LaserScan) -> None:
    """Ranges may be anything: 0, NaN and infinities have a meaning, and the rest is cut."""
    count, increment = len(message.ranges), message.angle_increment
    if not 0 < count <= MOST_RAYS:
        raise SizeError(f"{count} rays")
    check_header(message.header)
    check_within("first angle", message.angle_min, -TWO_TURNS, TWO_TURNS)
    check_within("last angle", message.angle_max, -TWO_TURNS, TWO_TURNS)
    check_within("angle between rays", increment, -TWO_TURNS, TWO_TURNS)
    span = increment * (count - 1)
    if abs(span) > TWO_TURNS or (count > 1 and increment == 0.0):
        raise RangeError(f"{count} rays at {increment:g} rad")
    # Some drivers count the last ray as one more or one less.
    if abs(message.angle_min + span - message.angle_max) > 2.0 * abs(increment) + 0.05 * abs(span):
        raise SizeError(f"{count} rays do not reach from the first to the last angle")
    check_within("time between rays", message.time_increment, 0.0, LONGEST_SCAN / count)
    check_within("least range", message.range_min, 0.0, FARTHEST)
    check_within("greatest range", message.range_max, message.range_min, FARTHEST)


def check_imu(message: Imu) -> None:
    """An orientation that is not measured may be anything."""
    check_header(message.header)
    rate, force, q = message.angular_velocity, message.linear_acceleration, message.orientation
    for value in (rate.x, rate.y, rate.z):
        check_within("a turn rate", value, -FASTEST, FASTEST)
    for value in (force.x, force.y, force.z):
        check_within("an acceleration", value, -HARDEST, HARDEST)
    if message.orientation_covariance[0] != -1.0 and any((q.x, q.y, q.z, q.w)):
        check_rotation(q)


def check_thermal(message: Float32MultiArray) -> None:
    """Whatever its layout says; a mission judges the temperatures."""
    pixels = BURGER.thermal_pixels**2
    if len(message.data) != pixels:
        raise SizeError(f"thermal frame of {len(message.data)} values, expected {pixels}")


def check_twist(message: Twist) -> None:
    for vector in (message.linear, message.angular):
        for value in (vector.x, vector.y, vector.z):
            check_within("a velocity", value, -FASTEST, FASTEST)


def check_stamped_twist(message: TwistStamped) -> None:
    check_header(message.header)
    check_twist(message.twist)
