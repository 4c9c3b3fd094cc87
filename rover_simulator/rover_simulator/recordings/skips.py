"""Why rows of a recorded run cannot be used, and what to do about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from rover_common.camera import ROVER_CAMERA
from rover_common.errors import RoverError

SIZE = f"{ROVER_CAMERA.width} x {ROVER_CAMERA.height}"


class Cause(Enum):
    """A cause in words for one frame or several, and its remedy."""

    CELLS = ("unreadable row", "look at these lines of the log")
    NO_PICTURE = ("no picture of that name", "copy the pictures there")
    POINTER = ("a pointer of git-lfs instead of a picture", "fetch them with 'git lfs pull'")
    BROKEN = ("no whole JPEG file", "copy the pictures again")
    OTHER_SIZE = (f"a picture of another size than {SIZE}", f"record with pictures of {SIZE}")
    JUMP = ("a position that the rover cannot have reached", "look at these lines of the log")

    @property
    def text(self) -> str:
        return self.value[0]

    @property
    def remedy(self) -> str:
        return self.value[1]


@dataclass(frozen=True)
class Skip:
    """One row that is not used."""

    line: int  # of the log, from 1
    cause: Cause
    detail: str  # what was found


class UnusableError(RoverError):
    """A row cannot be used; becomes a Skip."""

    def __init__(self, cause: Cause, detail: str) -> None:
        super().__init__(detail)
        self.cause, self.detail = cause, detail


def skips_in_words(skips: Sequence[Skip], total: int) -> list[str]:
    """A line for each cause, the commonest first; total: rows of the log."""
    lines = []
    for cause, some in by_cause(skips).items():
        first = some[0]
        lines.append(
            f"{len(some)} of {total} frames skipped: {cause.text} "
            f"(line {first.line}: {first.detail}); {cause.remedy}"
        )
    return lines


def by_cause(skips: Sequence[Skip]) -> dict[Cause, list[Skip]]:
    """The skips of each cause, the commonest first."""
    found: dict[Cause, list[Skip]] = {}
    for skip in skips:
        found.setdefault(skip.cause, []).append(skip)
    return dict(sorted(found.items(), key=lambda item: -len(item[1])))
