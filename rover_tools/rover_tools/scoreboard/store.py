"""The result folder: a JSON file, map, track and report per mission, written when it is over."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rover_common.whole_file import write_whole
from rover_tools.evaluation.results import Result
from rover_tools.scoreboard.errors import ScoreboardError
from rover_tools.scoreboard.missions import Files, MissionJob

MISSIONS = "missions"


@dataclass(frozen=True)
class Entry:
    """One mission of the folder."""

    name: str
    settings: dict[str, Any]
    failed: bool  # it raised; it runs again the next time
    result: Result

    @property
    def group(self) -> str:
        return str(self.settings["group"])

    @property
    def strategy(self) -> str:
        return str(self.settings["strategy"])

    @property
    def picture(self) -> str | None:
        """Relative to the result folder."""
        return None if self.failed else f"{MISSIONS}/{self.name}.svg"

    @property
    def report(self) -> str | None:
        """Relative to the result folder."""
        return None if self.failed else f"{MISSIONS}/{self.name}.html"


class Store:
    """The completed missions; a file counts only when it is whole."""

    def __init__(self, folder: Path, shared: Sequence[str]) -> None:
        """shared: settings that all missions of the folder have in common."""
        self.folder = folder
        self._shared = shared
        (folder / MISSIONS).mkdir(parents=True, exist_ok=True)

    def entries(self) -> list[Entry]:
        """All missions of the folder, by group, seed and strategy; raises ScoreboardError."""
        entries = [_read(path) for path in (self.folder / MISSIONS).glob("*.json")]
        return sorted(entries, key=lambda e: (e.group, e.settings["seed"], e.strategy))

    def missing(self, jobs: Iterable[MissionJob]) -> list[MissionJob]:
        """The jobs that have not run yet, and those that failed.

        Raises ScoreboardError when the folder holds missions with other settings: they are not
        to be mixed.
        """
        there = {entry.name: entry for entry in self.entries()}
        missing = []
        for job in jobs:
            wanted = job.settings()
            for entry in there.values():
                keys = wanted if entry.name == job.name else self._shared
                _check_same(entry, wanted, keys)
            if job.name not in there or there[job.name].failed:
                missing.append(job)
        return missing

    def add(self, job: MissionJob, result: Result, files: Files | None) -> None:
        """Write one mission, with its files by their suffixes; None for one that failed.

        The JSON file comes last, so that it marks a complete one.
        """
        path = self.folder / MISSIONS / f"{job.name}.json"
        for suffix, data in (files or {}).items():
            write_whole(path.with_name(job.name + suffix), data)
        content = {"settings": job.settings(), "failed": files is None, "result": result}
        write_whole(path, json.dumps(content, indent=2) + "\n")


def _read(path: Path) -> Entry:
    try:
        content = json.loads(path.read_text())
        return Entry(path.stem, content["settings"], content["failed"], content["result"])
    except (KeyError, TypeError, ValueError) as error:
        raise ScoreboardError(f"{path} is not a mission of a scoreboard; delete it") from error


def _check_same(entry: Entry, wanted: dict[str, Any], keys: Iterable[str]) -> None:
    for key in keys:
        there, here = entry.settings.get(key), wanted[key]
        if there != here:
            raise ScoreboardError(
                f"{entry.name} ran with {key} {there}, not {here}; choose another --out"
            )
