"""A mission of any kind: to run, and completed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from rover_tools.evaluation.results import Result

Files = Mapping[str, bytes]  # contents by suffix


class MissionJob(Protocol):
    """One mission to run, as plain data that can travel to another machine."""

    @property
    def name(self) -> str:
        """Of its files in the result folder."""

    def settings(self) -> dict[str, Any]:
        """All that the result depends on; `group`, `strategy` and `seed` among them."""


@dataclass(frozen=True)
class CompletedMission:
    """A mission that ended, with what it leaves to look at."""

    result: Result
    files: Files  # its map as .svg, its track as .csv, its report as .html
