"""What can be wrong with a telemetry; each defect is a type, and its name is its counter."""

from __future__ import annotations

from rover_common.errors import RoverError


class TelemetryError(RoverError, ValueError):
    """A telemetry that cannot be used."""

    counter = "telemetry_invalid"


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
    """A value is beyond what the simulator can mean."""

    counter = "telemetry_out_of_range"


class Base64Error(TelemetryError):
    """The image is not base64."""

    counter = "telemetry_broken_base64"


class JpegError(TelemetryError):
    """The image is not a whole JPEG file."""

    counter = "telemetry_broken_jpeg"


class ImageSizeError(TelemetryError):
    """The image has not the camera's size."""

    counter = "telemetry_image_size"
