"""Defects of a telemetry: each is a type, with its counter in /diagnostics."""

from __future__ import annotations

from typing import ClassVar

from rover_common.errors import RoverError


class TelemetryError(RoverError, ValueError):
    """A telemetry that cannot be used."""

    counter: ClassVar[str]  # in /diagnostics


class NotAnObjectError(TelemetryError):
    """The event carries no JSON object."""

    counter = "telemetry_not_an_object"


class MissingKeyError(TelemetryError):
    """A key of the telemetry is absent."""

    counter = "telemetry_missing_key"


class NumberError(TelemetryError):
    """A value is not the number, or the list of numbers, that it should be."""

    counter = "telemetry_not_a_number"


class NotFiniteError(TelemetryError):
    """A value is NaN or infinite."""

    counter = "telemetry_not_finite"


class OutOfRangeError(TelemetryError):
    """A value is outside of the range that the simulator can send."""

    counter = "telemetry_out_of_range"


class ClockAbsentError(TelemetryError):
    """There is no sim_time, where it is needed or was before."""

    counter = "telemetry_clock_absent"


class ClockJumpedError(TelemetryError):
    """The clock is far from where it was, or has come where none was."""

    counter = "telemetry_clock_jumped"


class ClockStandsError(TelemetryError):
    """The clock does not advance."""

    counter = "telemetry_clock_stands"


class Base64Error(TelemetryError):
    """The image is not base64."""

    counter = "telemetry_broken_base64"


class JpegError(TelemetryError):
    """The image is not a whole JPEG file."""

    counter = "telemetry_broken_jpeg"


class ImageSizeError(TelemetryError):
    """The image does not have the camera's size."""

    counter = "telemetry_image_size"
