"""What a panel is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

STAGES = (
    "grid", "top view", "field of view", "threshold", "rocks", "rover-centric", "world",
    "polar arrays",
)  # fmt: skip


@dataclass(frozen=True)
class Panel:
    """One drawing, and what its content is called in the code."""

    stage: str  # one of STAGES
    names: tuple[str, ...]  # of functions, classes and constants, with their modules
    draw: Callable[[Any], None]  # on axes
    note: str = ""  # a figure or two of this frame
    polar: bool = False

    @property
    def title(self) -> str:
        return f"{STAGES.index(self.stage) + 1}  {self.stage}"
