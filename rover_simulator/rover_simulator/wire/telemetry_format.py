"""The telemetry object as the Unity simulator writes it: every value a string, in this order."""

from __future__ import annotations

import base64
import math
from collections.abc import Sequence

from rover_common.geometry import Pose

Samples = Sequence[tuple[float, float]]

SWAPPED_MARKS = str.maketrans(".,", ",.")  # decimal mark and group mark of other locales


def format_telemetry(
    *,
    pose: Pose,
    speed: float,
    throttle: float,
    brake: float,
    steering_angle: float,
    near_sample: bool,
    picking_up: bool,
    sample_count: int,
    samples: Samples,
    image: bytes,
    sim_time: float | None = None,
    shows_insets: bool = False,
    separator: str = ";",
    decimal: str = ".",
) -> dict[str, str]:
    """The object of one telemetry event.

    Takes SI and REP-103: [m/s], [rad], samples as (x, y) [m], and a JPEG file. `decimal` is the
    mark of the machine's locale; `sim_time` [s] and `shows_insets` are this project's additions.
    """

    def number(value: float, digits: int = 4) -> str:
        return _marked(_fixed(value, digits), decimal)

    return {
        "steering_angle": number(math.degrees(steering_angle)),
        "throttle": number(throttle),
        "brake": number(brake),
        "speed": number(speed),
        "position": number(pose.x) + separator + number(pose.y),
        "pitch": number(_circle_deg(pose.pitch)),
        "yaw": number(_circle_deg(pose.yaw)),
        "roll": number(_circle_deg(-pose.roll)),  # the simulator's is positive right side up
        "near_sample": str(int(near_sample)),
        "picking_up": str(int(picking_up)),
        "sample_count": str(sample_count),
        "samples_x": separator.join(number(x, 2) for x, _ in samples),
        "samples_y": separator.join(number(y, 2) for _, y in samples),
        "image": base64.b64encode(image).decode("ascii"),
        **_additions(sim_time, shows_insets, decimal),
    }


def _additions(sim_time: float | None, shows_insets: bool, decimal: str) -> dict[str, str]:
    """What the original does not send; without groups of thousands: plain for any reader."""
    additions = {}
    if sim_time is not None:
        additions["sim_time"] = f"{sim_time:.4f}".replace(".", decimal)
    if shows_insets:
        additions["shows_insets"] = "1"
    return additions


def _marked(text: str, decimal: str) -> str:
    return text if decimal == "." else text.translate(SWAPPED_MARKS)


def _fixed(value: float, digits: int) -> str:
    """As .NET's formats N4 and N2 have it: thousands in groups, no minus before a zero."""
    text = f"{value:,.{digits}f}"
    return text if text.strip("-0.") else text.removeprefix("-")


def _circle_deg(angle: float) -> float:
    """An angle [rad] in degrees, [0, 360)."""
    degrees = math.degrees(angle) % 360.0
    return 0.0 if degrees == 360.0 else degrees  # the remainder of a tiny negative angle
