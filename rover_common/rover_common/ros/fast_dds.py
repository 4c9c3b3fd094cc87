"""The settings of Fast DDS that every node of the graph starts with."""

from __future__ import annotations

import os
from pathlib import Path

VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"  # read when a process makes its first context
PROFILES = Path(__file__).with_suffix(".xml")
PATIENT_PROFILES = PROFILES.with_name("fast_dds_patient.xml")  # Fast DDS reads one file only


def use_profiles() -> None:
    """Call before rclpy.init; a file that the environment names takes precedence, also none."""
    os.environ.setdefault(VARIABLE, str(PROFILES))


def use_patient_profiles() -> None:
    """As use_profiles, for a node that may stand still for seconds and still get every message."""
    use_profiles()
    if Path(os.environ[VARIABLE]).resolve() == PROFILES.resolve():  # not of the user
        os.environ[VARIABLE] = str(PATIENT_PROFILES)
