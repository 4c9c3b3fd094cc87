"""Where recorded runs are found, for benchmarks and demonstrations."""

from __future__ import annotations

import os
from pathlib import Path

from rover_simulator.recordings.recording import Recording, YawConvention, read_recording
from rover_tools.output import note

DATA_VARIABLE = "ROVER_DATA"
DEFAULT_DATA = Path("..") / "shared" / "data"  # from the folder that the command runs in


def load_log(folder: Path, yaw_convention: YawConvention = "ccw-from-east") -> Recording:
    """Read a run of the simulator, and tell what its user should know. As `read_recording`."""
    recording = read_recording(folder, yaw_convention)
    for remark in recording.remarks():
        note(remark)
    return recording


def data_folder() -> Path:
    """The folder of recorded runs, whether it exists or not."""
    return Path(os.environ.get(DATA_VARIABLE, DEFAULT_DATA))


def example_recording(chosen: Path | None, scratch: Path) -> tuple[Recording, str]:
    """A run to measure with, and where it comes from.

    The chosen folder, or the recorded test run where it is there, or a drive rendered by the
    embedded simulator into the scratch folder.
    """
    if chosen is not None:
        return load_log(chosen), str(chosen)
    recorded = data_folder() / "udacity" / "test_dataset"
    if recorded.is_dir():
        return read_recording(recorded), str(recorded)
    from rover_simulator.recordings.recorder import record_drive  # renders: slow to import

    folder = scratch / "recording"
    record_drive(folder)
    return read_recording(folder), "embedded simulator"
