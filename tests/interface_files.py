"""Reads .msg and .action files: their fields and constants, with types and comments."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent / "rover_interfaces"
SECTIONS = {".msg": ("",), ".action": ("goal", "result", "feedback")}


@dataclass(frozen=True)
class Member:
    """A field or a constant."""

    section: str  # of an action; empty for a message
    name: str  # with its value, where it is a constant
    type: str
    comment: str


def interface_files() -> list[Path]:
    return sorted([*ROOT.glob("msg/*.msg"), *ROOT.glob("action/*.action")])


def members_of(path: Path) -> list[Member]:
    """All members in their order."""
    members = []
    parts = path.read_text().split("\n---\n")
    for section, part in zip(SECTIONS[path.suffix], parts, strict=True):
        for line in part.splitlines():
            code, _, comment = line.partition("#")
            if code.strip():
                kind, name = code.split(maxsplit=1)
                members.append(Member(section, name.strip(), kind, comment.strip()))
    return members
