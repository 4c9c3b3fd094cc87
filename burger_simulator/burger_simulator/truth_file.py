"""The truth of a run as a file, for scoring: no topic carries it."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from burger_simulator.truth import Launch, Truth
from rover_common.geometry import Pose


class TruthFile:
    """A JSON line per tick; each simulated second is on the disk when it is over."""

    def __init__(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self._file = path.open("w")
        self._flushed = 0.0  # [s]

    def write(self, truth: Truth) -> None:
        self._file.write(json.dumps(asdict(truth)) + "\n")
        if truth.time - self._flushed >= 1.0:
            self._file.flush()
            self._flushed = truth.time

    def close(self) -> None:
        self._file.close()


def read_truth(path: Path) -> list[Truth]:
    """Each tick that was written whole."""
    lines = path.read_text().splitlines(keepends=True)
    return [_truth_of(json.loads(line)) for line in lines if line.endswith("\n")]


def _truth_of(data: dict) -> Truth:
    launches = tuple(
        Launch(**launch | {"pose": Pose(**launch["pose"])}) for launch in data["launches"]
    )
    return Truth(**data | {"pose": Pose(**data["pose"]), "launches": launches})
