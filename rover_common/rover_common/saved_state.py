"""What a program has to know again after it was killed, as a file with its own check.

The first line tells what the file is: its kind, the version of its content, the size and the
checksum of all that follows, which is a NumPy archive without pickled objects. A file is used as a
whole or not at all.
"""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.errors import RoverError
from rover_common.types import Run
from rover_common.whole_file import write_whole

FORMAT = "rover state 1"
MOST_BYTES = 200_000_000  # a file beyond is none of ours
VALUES = "values"  # member of the archive: JSON in UTF-8


Memory = tuple[dict[str, Any], dict[str, NDArray[Any]]]  # values and arrays of a SavedState


def joined(**parts: Memory) -> Memory:
    """The memories of several parts as one."""
    values = {name: part for name, (part, _) in parts.items()}
    arrays = {f"{name}.{key}": a for name, (_, part) in parts.items() for key, a in part.items()}
    return values, arrays


def part_of(memory: Memory, name: str) -> Memory:
    """One of those that were joined; raises KeyError."""
    values, arrays = memory
    begin = f"{name}."
    own = {key.removeprefix(begin): a for key, a in arrays.items() if key.startswith(begin)}
    return values[name], own


class StateError(RoverError, ValueError):
    """A file that is torn, foreign, or of another version."""


@dataclass(frozen=True)
class SavedState:
    """What is kept of one run, up to one of its frames."""

    run: Run
    stamp: int  # [ns] of the newest frame that it holds
    values: dict[str, Any]  # whatever JSON takes
    arrays: dict[str, NDArray[Any]] = field(default_factory=dict)

    def continues_with(self, run: Run, stamp: int) -> bool:
        """Whether a frame of this run and stamp [ns] can follow; stamps never fall back in one."""
        return self.run == run and self.stamp <= stamp


@dataclass(frozen=True)
class StateFile:
    """The newest state that was written, and the one before it as the older good copy."""

    path: Path
    kind: str  # whose state it is
    version: int  # of its content

    @property
    def older(self) -> Path:
        return self.path.with_name(self.path.name + ".old")

    def write(self, state: SavedState) -> None:
        """Raises OSError; what was there stays then."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        content = _encoded(state, self.kind, self.version)
        if self.path.exists():
            self.path.replace(self.older)
        write_whole(self.path, content)

    def read(self) -> tuple[list[SavedState], list[str]]:
        """What can be used, the newest first, and a line for each file that is refused."""
        states, refusals = [], []
        for path in (self.path, self.older):
            try:
                states.append(_decoded(_content_of(path), self.kind, self.version))
            except FileNotFoundError:
                continue
            except (OSError, StateError) as error:
                refusals.append(f"{path} is not used: {error}")
        return states, refusals


def _content_of(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(MOST_BYTES)


def _encoded(state: SavedState, kind: str, version: int) -> bytes:
    values = {"run": [state.run.number, state.run.start], "stamp": state.stamp, **state.values}
    text = np.frombuffer(json.dumps(values).encode(), np.uint8)
    archive = io.BytesIO()
    members: dict[str, Any] = {VALUES: text, **state.arrays}
    np.savez(archive, **members)
    body = archive.getvalue()
    header = {
        "format": FORMAT,
        "kind": kind,
        "version": version,
        "size": len(body),
        "crc32": zlib.crc32(body),
    }
    return json.dumps(header).encode() + b"\n" + body


def _decoded(content: bytes, kind: str, version: int) -> SavedState:
    """Raises StateError."""
    first, _, body = content.partition(b"\n")
    try:
        header = json.loads(first)
        what = header["format"], header["kind"], header["version"]
        size, checksum = header["size"], header["crc32"]
    except (ValueError, TypeError, KeyError) as error:
        raise StateError("it is no saved state") from error
    if what != (FORMAT, kind, version):
        raise StateError(f"it holds {what}, not {(FORMAT, kind, version)}")
    if size != len(body) or checksum != zlib.crc32(body):
        raise StateError(f"it is torn: {len(body)} of {size} bytes, or its checksum is wrong")
    try:
        with np.load(io.BytesIO(body), allow_pickle=False) as archive:
            arrays = dict(archive)
        values = json.loads(arrays.pop(VALUES).tobytes())
        number, start = values.pop("run")
        return SavedState(Run(int(number), int(start)), int(values.pop("stamp")), values, arrays)
    except (ValueError, TypeError, KeyError, zipfile.BadZipFile) as error:
        raise StateError("its content is not that of a saved state") from error
