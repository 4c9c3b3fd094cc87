"""All stages of one frame in one picture: ours beside the baseline's."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure, SubFigure

from rover_common.whole_file import whole_file
from rover_tools.explain.baseline_panels import baseline_panels
from rover_tools.explain.baseline_stages import run_baseline
from rover_tools.explain.frames import ExplainedFrames
from rover_tools.explain.our_panels import our_panels
from rover_tools.explain.our_stages import run_our_stages
from rover_tools.explain.panels import Panel

STAGES_PER_ROW = 2
STAGE_SIZE = (8.6, 4.3)  # [in]
TITLE_HEIGHT = 0.45  # [in] of the whole picture's title
DPI = 100
NOTEBOOK_DPI, JPEG_QUALITY = 80, 75
LEFT, BOTTOM, WIDTH, HEIGHT = 0.06, 0.27, 0.42, 0.58  # of axes in their stage, of its size
NOTE, NAMES, LINE = 0.14, 0.085, 0.038  # heights of the note, the first name, and a line
SIDES = ("ours", "baseline")
BACKGROUND = "#f4f4f1"


def stage_panels(source: ExplainedFrames) -> list[tuple[Panel, Panel]]:
    """Ours and the baseline's of each stage. Raises FrameError and NoGroundError."""
    ours, baseline = run_our_stages(source), run_baseline(source.frames)
    return list(zip(our_panels(ours), baseline_panels(baseline), strict=True))


class Picture(Figure):
    """A figure that a notebook shows by itself, without pyplot."""

    def _repr_jpeg_(self) -> bytes:
        """Smaller than PNG, for what holds photographs."""
        file = io.BytesIO()
        self.savefig(file, format="jpeg", dpi=NOTEBOOK_DPI, pil_kwargs={"quality": JPEG_QUALITY})
        return file.getvalue()


def draw_stages(pairs: Sequence[tuple[Panel, Panel]], title: str = "") -> Picture:
    """Two stages in a row."""
    columns = min(STAGES_PER_ROW, len(pairs))
    rows = -(-len(pairs) // columns)
    heights = TITLE_HEIGHT if title else 0.01, STAGE_SIZE[1] * rows
    figure = Picture(figsize=(STAGE_SIZE[0] * columns, sum(heights)), dpi=DPI)
    head, body = np.asarray(figure.subfigures(2, height_ratios=heights))
    head.text(0.5, 0.3, title, fontsize=13, ha="center")
    parts = np.ravel(body.subfigures(rows, columns, wspace=0.01, hspace=0.02))
    for part, pair in zip(parts, pairs, strict=False):
        part.set_facecolor(BACKGROUND)
        part.text(0.5, 0.94, pair[0].title, fontsize=12, weight="bold", ha="center")
        for side, panel in enumerate(pair):
            _draw_panel(part, side, panel)
    return figure


def explain(source: ExplainedFrames, file: Path) -> None:
    """Write the picture as PNG. Raises as `stage_panels`, and OSError."""
    figure = draw_stages(stage_panels(source), source.title)
    with whole_file(file) as draft:
        figure.savefig(draft, format="png")


def _draw_panel(part: SubFigure, side: int, panel: Panel) -> None:
    """Ours on side 0, the baseline's on side 1."""
    left = LEFT + 0.5 * side
    ax = part.add_axes((left, BOTTOM, WIDTH, HEIGHT), projection="polar" if panel.polar else None)
    panel.draw(ax)
    middle = left + WIDTH / 2
    part.text(middle, BOTTOM + HEIGHT + 0.02, SIDES[side], fontsize=9, ha="center")
    part.text(middle, NOTE, panel.note, fontsize=8.5, ha="center")
    for line, name in enumerate(panel.names):
        part.text(middle, NAMES - line * LINE, name, fontsize=6.5, ha="center", family="monospace")
