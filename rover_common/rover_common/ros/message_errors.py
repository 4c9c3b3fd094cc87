"""Why a message cannot be used: each is a type, with the cause that /diagnostics counts it by."""

from __future__ import annotations

from typing import ClassVar

from rover_common.errors import RoverError


class MessageError(RoverError, ValueError):
    """A message that cannot be used."""

    cause: ClassVar[str] = "unusable"


class SizeError(MessageError):
    """It does not hold as much as it says, or more than any that is meant."""

    cause = "size"


class NotFiniteError(MessageError):
    """A number is NaN or infinite where neither has a meaning."""

    cause = "not_finite"


class RangeError(MessageError):
    """A number is outside of what can be."""

    cause = "range"


class RotationError(MessageError):
    """A quaternion is not of length 1."""

    cause = "rotation"


class EncodingError(MessageError):
    """A picture of a kind that is not read here."""

    cause = "encoding"


class FrameError(MessageError):
    """It is given in another coordinate frame, or in one that has no legal name."""

    cause = "frame"


class StampError(MessageError):
    """A stamp that is no time, or ahead of the node's clock."""

    cause = "stamp"
