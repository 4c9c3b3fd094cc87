"""What can be wrong with a recording."""

from __future__ import annotations

from rover_common.errors import RoverError


class RecordingError(RoverError, ValueError):
    """A recording that cannot be written or read."""
