"""The settings of Fast DDS that every node of the graph starts with."""

from __future__ import annotations

import os
from pathlib import Path

VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"  # read when a process makes its first context
PROFILES = Path(__file__).with_suffix(".xml")
# [ms] until a process that reads nothing is taken for dead; PROFILES asks for this variable.
DEAD_AFTER = "ROVER_DDS_DEAD_AFTER_MS"
USUAL, PATIENT = "1000", "5000"  # the default of Fast DDS; where no message may be lost


def use_profiles() -> None:
    """Call before rclpy.init; a file that the environment names takes precedence, also none."""
    os.environ.setdefault(VARIABLE, str(PROFILES))
    os.environ.setdefault(DEAD_AFTER, USUAL)


def use_patient_profiles() -> None:
    """As use_profiles, for a node that may stand still for seconds and still get every message."""
    os.environ[DEAD_AFTER] = PATIENT
    use_profiles()
