"""The settings of Fast DDS that every node of the graph starts with."""

from __future__ import annotations

import os
from pathlib import Path

VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"  # read when a process makes its first context
PROFILES = Path(__file__).with_suffix(".xml")


def use_profiles() -> None:
    """Call before rclpy.init; a file that the environment names takes precedence, also none."""
    os.environ.setdefault(VARIABLE, str(PROFILES))
