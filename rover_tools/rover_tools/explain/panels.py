"""What a panel is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Panel:
    """One drawing, and what its content is called in the code."""

    stage: str  # its title; ours and the baseline's of one stage have the same
    names: tuple[str, ...]  # of functions, classes and constants, with their modules
    draw: Callable[[Any], None]  # on axes
    note: str = ""  # a figure or two of this frame
    polar: bool = False
