"""One word for one thing, in code, messages, documents, tests and output: the field's."""

from __future__ import annotations

import re
import subprocess
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
# The command line's hints name what people may type instead; vendored files are others' work.
NOT_YET = (
    "rover_dashboard/rover_dashboard/static/vendor", "rover_tools/rover_tools/cli/hints.py",
    "tests/tools/test_command_line.py",
)  # fmt: skip
# What is not written, as a pattern without regard to case, and what is written instead.
WORDS = {
    r"drivable_?way|home_?way|\bfree way\b": "path, home_path",
    r"(?<!bread)crumb": "breadcrumb",
    r"\bdesk\b|plandesk": "plan scheduler",
    r"\bdata_?flow\b": "types",
    r"\broomy\b|roomier": "wide, clearance",
    r"\b(foot|feet) of (an? |the )?walls?|walls?'s? (foot|feet)": "base (of a wall)",
    r"\blooked at\b|\bfoot looks?\b": "observed, observations",
    r"\bbelieved?\b": "confirmed",
    r"\brockdetection\b": "RockTrack",
    r"frame_? ?gate": "frame validation",
    r"held_?monitor|progress_?monitor": "stall monitor, progress checker",
    r"searched ground|hiding place": "coverage grid, unsearched cells",
    r"\bdoubt(ful)?\b|goal_?memory": "blacklisted, retryable, goal history",
    r"\bladders?\b|\brungs?\b": "recovery sequence, recovery step",
    r"what_happened|\bsituations?\b": "detect event, tick context",
    r"stamp_? ?join": "exact time synchronizer",
    r"\bexchang": "request and answer, pending requests",
    r"\btickets?\b": "pending request",
    r"\badmit": "accept",
    r"\bdriving client|active driver|client drives": "active client",
    r"\bdialects?\b|bilingual": "protocol, dual protocol, number format",
    r"protocol_? ?trouble": "protocol error",
    r"\bfl(y|ies|own|ew)\b|(?<!in[ _-])\bflights?\b|in the air": "run, mission run, in progress",
    r"usual recipe|reference recipe": "baseline",
    r"driving map": "navigation map",
    r"\bpercepts?\b": "perception result",
}


@cache
def checked_lines() -> str:
    """In small letters, place and text of each line of the tracked files, but of those above."""
    tracked = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split("\0")
    exempt = [ROOT / name for name in (*NOT_YET, Path(__file__))]
    return "\n".join(
        f"{path.relative_to(ROOT)}:{number} {line.strip()}"
        for path in (ROOT / name for name in tracked if name)
        if path.is_file()
        and path.suffix not in (".png", ".jpg", ".webm", ".webp", ".mcap")
        and not any(path.is_relative_to(folder) for folder in exempt)
        for number, line in enumerate(path.read_text().splitlines(), 1)
    ).lower()


def test_what_is_exempt_is_there():
    assert all((ROOT / name).exists() for name in NOT_YET)


@pytest.mark.parametrize(("pattern", "instead"), WORDS.items(), ids=list(WORDS.values()))
def test_the_fields_word_is_used(pattern, instead):
    lines = checked_lines()
    found = [
        lines[lines.rfind("\n", 0, match.start()) + 1 :].partition("\n")[0]
        for match in re.finditer(pattern, lines)
    ]
    assert found == [], f"write: {instead}"
