"""The recording of a run: the recorder's node as a process, from its first frame to its last."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rover_recorder.reader import FOLDER, Recording, open_recording
from rover_tools.output import note
from rover_tools.runner.graph import executable
from rover_tools.runner.run import ProcessRun

RECORDER = "recorder_node"


def recorder_command(folder: Path, mission: str = "rover") -> list[str]:
    """The command that records the running graph of a mission into a folder."""
    value = json.dumps(str(folder.absolute()), ensure_ascii=False)
    command = [executable("rover_recorder", RECORDER), "--ros-args", "-p", f"folder:={value}"]
    return [*command, "-p", f"mission:={mission}"]


def load_recording(path: Path) -> Recording:
    """Open the recording that a path names; salvaging it is told. As `open_recording` raises."""
    opened = open_recording(path)
    if opened.salvaged:
        count = sum(opened.counts.values())
        note(f"{opened.path}: its recorder was killed; salvaged {count} messages")
    return opened


@contextmanager
def recording(run: ProcessRun[Any], wanted: bool = True, mission: str = "rover") -> Iterator[None]:
    """Record what happens in the block into the run's folder, in place of an older recording.

    The node ends while the graph still runs, so that its final state is recorded. Raises
    GraphNotReadyError or ProcessDiedError, but a recording that ends too early is only a note.
    """
    if not wanted:
        yield
        return
    folder = run.folder / FOLDER
    shutil.rmtree(folder, ignore_errors=True)
    run.processes.start(RECORDER, recorder_command(folder, mission))
    run.wait_ready([RECORDER])
    run.processes.make_optional(RECORDER)  # a mission must not end with a full disk
    yield
    if run.processes.ended(RECORDER) is None:
        run.processes.end(RECORDER)
    else:
        note(f"the recording has ended too early: {run.processes.last_line(RECORDER)}")
