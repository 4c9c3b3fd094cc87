"""What a check says: in order, or a mistake with its remedy."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Level(Enum):
    """How bad it is; the texts begin the lines, as those of ./rover do."""

    OK = "ok"
    NOTE = "note"  # something that ./rover copes with, but others may not
    WRONG = "wrong"  # the graph will not work


@dataclass(frozen=True)
class Finding:
    """The result of one check."""

    name: str
    level: Level = Level.OK
    text: str = ""  # what is wrong, and the remedy

    def line(self) -> str:
        return f"{self.level.value:9}{self.name}" + (f": {self.text}" if self.text else "")


def note(name: str, text: str) -> Finding:
    return Finding(name, Level.NOTE, text)


def wrong(name: str, text: str) -> Finding:
    return Finding(name, Level.WRONG, text)
