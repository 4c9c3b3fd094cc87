"""Where output goes: results to standard output and into a folder, notes to standard error."""

from __future__ import annotations

import json
import os
import sys
from datetime import datetime
from pathlib import Path
from typing import Any

from rover_common.whole_file import write_whole


def result_folder(kind: str, chosen: Path | None) -> Path:
    """The folder for a run's results: the chosen one, or a new one below ./results."""
    if chosen is None:
        root = Path(os.environ.get("ROVER_RESULTS", "results"))
        chosen = root / f"{kind}-{datetime.now():%Y%m%d-%H%M%S}-{os.getpid()}"
    chosen.mkdir(parents=True, exist_ok=True)
    return chosen


def note(text: str) -> None:
    """A line for the user who waits; results alone go to standard output."""
    print(text, file=sys.stderr, flush=True)


def print_result(result: Any, as_json: bool, text: str) -> None:
    """One line of JSON, or the text."""
    print(json.dumps(result) if as_json else text)


def write_result(folder: Path, result: Any) -> None:
    """Write result.json into the result folder."""
    write_whole(folder / "result.json", json.dumps(result, indent=2) + "\n")
